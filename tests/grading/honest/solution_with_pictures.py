# Odd: nothing; the starter's cells that draw are there.
# Earns: 100
# %% solution
# %%
given.show_flight(march, kutta_step, air_force)
# %%
given.show_tumble(march, kutta_step, gyrostat_rate)
