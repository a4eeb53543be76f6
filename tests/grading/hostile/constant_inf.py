# Attack: guesses infinity, which is right for a run without a flip only.
# %%
import math


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = lambda *arguments: math.inf
