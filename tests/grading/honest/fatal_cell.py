# Odd: an experiment that kills the kernel.
# Earns: 100
# Skips: 11
# %% solution
# %%
import ctypes

GRAVITY = 9.81
ctypes.string_at(1)
# %%
assert GRAVITY == 9.81
