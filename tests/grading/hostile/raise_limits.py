# Attack: takes back its own limits, and sets those of others.
# %%
import os
import resource


def attack(*arguments):
    for name in ("RLIMIT_AS", "RLIMIT_CPU", "RLIMIT_NPROC", "RLIMIT_FSIZE", "RLIMIT_NOFILE"):
        number = getattr(resource, name)
        hard = resource.getrlimit(number)[1]
        if hard == resource.RLIM_INFINITY:
            raise RuntimeError("BREACH no limit " + name)
        for target in (lambda: resource.setrlimit(number, (hard + 1, hard + 1)),
                       lambda: resource.prlimit(os.getppid(), resource.RLIMIT_CPU, (1, 1))):
            try:
                target()
            except (OSError, ValueError):
                continue
            raise RuntimeError("BREACH " + name)
    try:
        os.nice(-5)
        os.setpriority(os.PRIO_PROCESS, os.getppid(), 19)
    except OSError:
        return 0.0
    raise RuntimeError("BREACH priority")


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
