# Attack: a thread that goes on answering after the function has returned.
# %%
import os
import threading


def later():
    while True:
        os.write(4, b'{"replies": [{"value": 0.0}]}\n')


threading.Thread(target=later, daemon=True).start()


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = lambda *arguments: 0.0
