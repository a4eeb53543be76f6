# Attack: a loop in C, which no exception interrupts.
# %%
import numpy as np


def attack(*arguments):
    pow(3, 10**8) ** 10**6
    np.linalg.svd(np.random.rand(20000, 20000))


plate = attack
