# Attack: processes by the standard library.
# %%
import multiprocessing
import os


def attack(*arguments):
    for kind in ("fork", "spawn", "forkserver"):
        try:
            process = multiprocessing.get_context(kind).Process(target=os.getpid)
            process.start()
        except OSError:
            continue
        raise RuntimeError("BREACH started a process by " + kind)
    os.posix_spawn("/bin/true", ["true"], {})


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
