# Odd: one function crashes the process, one never ends, one is not there; the others count.
# Earns: 60
# Status: timeout crashed
# %% solution
# %%
import ctypes


def plate(*arguments):
    ctypes.string_at(1)


def body_rate(*arguments):
    while True:
        pass


del air_force
