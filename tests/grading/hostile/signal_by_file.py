# Attack: lets the kernel send a signal for it: owner of a file, timers, leases.
# %%
import fcntl
import os


def attack(*arguments):
    reading, writing = os.pipe()
    for command, value in ((8, os.getppid()), (8, -os.getpgrp()), (10, 9), (1024, 1), (1031, 1 << 30)):
        try:
            fcntl.fcntl(reading, command, value)
        except OSError:
            continue
        raise RuntimeError(f"BREACH fcntl {command}")
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
