# Attack: ends the process in a cell and in a function, with success.
# %%
import os


def attack(*arguments):
    os._exit(0)


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
# %%
os._exit(0)
