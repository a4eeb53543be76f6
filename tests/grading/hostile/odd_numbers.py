# Attack: NaN, infinities, huge whole numbers, True for 1.
# %%
import math

plate = lambda *arguments: (math.nan, math.nan, math.nan)
body_rate = lambda *arguments: [math.nan] * 4
gyrostat_rate = lambda *arguments: 10**5000
air_force = lambda *arguments: [2**63] * 3
kutta_step = lambda rate, t, y, dt: y * math.nan
march = lambda *arguments: [[math.inf] * 2] * 6
flip_time = lambda *arguments: -math.inf
swing = lambda *arguments: True
