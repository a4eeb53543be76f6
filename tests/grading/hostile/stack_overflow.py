# Attack: recursion without end, in Python and in C.
# %%
import sys

sys.setrecursionlimit(10**9)


def attack(*arguments):
    return attack(*arguments)


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
