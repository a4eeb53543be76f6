# Odd: an experiment that takes for ever, in a cell that holds a function, too.
# Earns: 100
# Skips: 2
# %%
import time
# %%
import math

import numpy as np

STEP = 0.5
TABLE = {"a": [1, 2, (3, -4.5)]}


def body_rate(q, omega):
    w, x = q[0], q[1:]
    return STEP * np.concatenate([[-x @ omega], w * omega + np.cross(x, omega)])


while True:
    time.sleep(0.1)
# %% solution but body_rate
# %%
assert TABLE["a"][2] == (3, -4.5)
