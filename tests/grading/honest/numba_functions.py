# Odd: compiled functions, with a cache, in different cells, that call one another.
# Earns: 100
# %%
import numpy as np
from numba import njit, prange
# %% solution
# %%
@njit(cache=True)
def cross(a, b):
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
# %%
@njit(cache=True, fastmath=False)
def rate_of(q, omega):
    out = np.empty(4)
    out[0] = -0.5 * (q[1] * omega[0] + q[2] * omega[1] + q[3] * omega[2])
    out[1:] = 0.5 * (q[0] * omega + cross(q[1:], omega))
    return out


rate_of(np.array([1.0, 0, 0, 0]), np.zeros(3))


def body_rate(q, omega):
    return rate_of(q, omega)
