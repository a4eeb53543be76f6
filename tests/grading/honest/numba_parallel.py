# Odd: a compiled loop on several threads.
# Earns: 100
# %%
import numba
import numpy as np


@numba.njit(parallel=True)
def scaled(x):
    out = np.empty_like(x)
    for i in numba.prange(len(x)):
        out[i] = 0.5 * x[i]
    return out


scaled(np.ones(100))
# %% solution
# %%
def body_rate(q, omega):
    w, x = q[0], q[1:]
    return scaled(np.concatenate([np.array([-x @ omega]), w * omega + np.cross(x, omega)]))
