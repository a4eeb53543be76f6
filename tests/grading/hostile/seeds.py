# Attack: learns the hidden cases from the generators' state.
# %%
import random

import numpy as np

DRAWN = [np.random.default_rng([seed, 0]).uniform() for seed in range(5)]
np.random.default_rng = lambda *seed: type("Zero", (), {"__getattr__": lambda self, name: lambda *a, **o: 0.0})()
np.random.seed = random.seed = lambda *seed: None
random.setstate = lambda state: None


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = lambda *arguments: np.random.rand()
