# Attack: an answer of hundreds of megabytes.
# %%
import numpy as np


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = lambda *arguments: np.zeros(30_000_000)
