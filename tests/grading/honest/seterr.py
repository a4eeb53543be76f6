# Odd: makes NumPy raise on overflow, and sets how numbers are shown.
# Earns: 100
# %%
import numpy as np

np.seterr(all="raise")
np.set_printoptions(precision=2)
# %% solution
# %%
import sys

sys.setrecursionlimit(5000)
