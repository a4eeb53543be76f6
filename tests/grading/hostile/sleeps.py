# Attack: sleeps, so that a whole class waits.
# %%
import time


def plate(*arguments):
    time.sleep(10**6)


# %%
time.sleep(10**6)
