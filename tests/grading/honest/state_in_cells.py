# Odd: state that functions share, counted in cells and in calls; random numbers.
# Earns: 100
# %%
import random

count = 0
random.seed(7)
# %% solution
# %%
counted = air_force


def air_force(*arguments):
    global count
    count += 1
    cache.setdefault("first", arguments)
    random.random()
    np.random.rand()
    return counted(*arguments)


cache = {}
