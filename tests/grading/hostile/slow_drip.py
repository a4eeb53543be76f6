# Attack: sends a byte now and then, so that something always comes.
# %%
import os
import time


def plate(*arguments):
    while True:
        os.write(4, b" ")
        time.sleep(0.05)
