# Attack: zeros of every fitting shape.
# %%
import numpy as np

plate = lambda *arguments: (0.0, np.zeros(2), 0.0)
body_rate = lambda *arguments: np.zeros(4)
gyrostat_rate = air_force = lambda *arguments: np.zeros(3)
kutta_step = lambda rate, t, y, dt: np.zeros_like(y)
march = lambda step, rate, y, dt, steps: np.zeros((steps + 1, len(y)))
flip_time = lambda *arguments: 0.0
swing = lambda mass, inertia, length, angle, dt, steps: np.zeros(steps + 1)
