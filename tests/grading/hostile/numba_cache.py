# Attack: leaves a poisoned cache for the next one who compiles.
# %%
import glob
import os

import numba


@numba.njit(cache=True)
def compiled(x):
    return x + 1.0


compiled(1.0)


def attack(*arguments):
    kept = [path for folder in (".", os.environ.get("HOME", "."), os.environ.get("TMPDIR", "."))
            for path in glob.glob(folder + "/**/*.nb[ic]", recursive=True)]
    if kept:
        raise RuntimeError("BREACH a cache at " + kept[0])
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
