# Attack: gives back what it was given.
# %%
plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = lambda *arguments: arguments[-1] if len(arguments) < 3 else arguments[2]
