# Attack: uses files that the grader left open.
# %%
import os
import stat


def attack(*arguments):
    for number in range(5, 1024):
        try:
            mode = os.fstat(number).st_mode
        except OSError:
            continue
        if stat.S_ISREG(mode) or stat.S_ISDIR(mode) or stat.S_ISSOCK(mode):
            raise RuntimeError(f"BREACH file {number}")
    try:
        os.listdir(3)
    except OSError:
        return 0.0
    raise RuntimeError("BREACH folder")


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
