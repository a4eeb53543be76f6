# Attack: arrays that claim to be large: empty ones, sparse ones, strided ones.
# %%
import numpy as np
import scipy.sparse

plate = lambda *arguments: (scipy.sparse.coo_array((2**31 - 1, 2**31 - 1)),) * 3
body_rate = lambda *arguments: scipy.sparse.coo_array((2**31 - 1, 1))
gyrostat_rate = lambda *arguments: np.broadcast_to(0.0, (2**40,))
air_force = lambda *arguments: np.zeros((0, 2**40))
kutta_step = lambda *arguments: np.zeros((1,) * 20)
march = lambda *arguments: np.zeros((2**20, 0))
flip_time = lambda *arguments: np.zeros(())
swing = lambda *arguments: scipy.sparse.csr_array((5, 2**30))
