# Attack: reads the grader's environment and memory map by /proc.
# %%
import glob


def attack(*arguments):
    for path in glob.glob("/proc/[0-9]*/environ") + glob.glob("/proc/[0-9]*/maps") + ["/proc/1/environ"]:
        try:
            data = open(path, "rb").read()
        except OSError:
            continue
        if data and "self" not in path:
            raise RuntimeError("BREACH read " + path)
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
