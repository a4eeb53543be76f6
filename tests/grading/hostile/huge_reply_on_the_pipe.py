# Attack: never ends its line.
# %%
import os


def attack(*arguments):
    while True:
        os.write(4, b"x" * 60_000)


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
