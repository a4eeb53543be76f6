# Attack: fills the disk with empty files, deep folders, links and pipes.
# %%
import os


def attack(*arguments):
    made = 0
    for number in range(200_000):
        try:
            open(f"n{number}", "w").close()
            made += 1
        except OSError:
            break
    if made > 100_000:
        raise RuntimeError("BREACH files without end")
    for _ in range(5000):
        try:
            os.mkdir("d")
            os.chdir("d")
        except OSError:
            break
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
