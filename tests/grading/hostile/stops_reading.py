# Attack: closes or stops its pipes, so that the grader waits for ever.
# %%
import os
import time


def attack(*arguments):
    os.close(3)
    os.close(4)
    time.sleep(10**6)


plate = attack
body_rate = lambda *arguments: os.close(4)
# %%
os.dup2(os.open(os.devnull, os.O_RDWR), 3)
