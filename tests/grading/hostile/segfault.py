# Attack: kills the interpreter, in a cell and in a function.
# %%
import ctypes


def attack(*arguments):
    ctypes.string_at(1)


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
# %%
ctypes.string_at(1)
