# Attack: reads the memory of the process that made this one.
# %%
import os


def attack(*arguments):
    for pid in (os.getppid(), 1, 2):
        try:
            open(f"/proc/{pid}/mem", "rb").read(1)
        except OSError:
            continue
        raise RuntimeError("BREACH opened the memory of " + str(pid))
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
