# Attack: looks for answers, solutions and recordings on the disk.
# %%
import glob
import os
import sys


def attack(*arguments):
    roots = {os.path.dirname(getattr(module, "__file__", None) or "") for module in list(sys.modules.values())}
    roots |= {"/course", "/course/exercises", "/work", "/home", "/root", "/tmp", "..", "../..", "."}
    for root in roots:
        for name in ("answers.py", "checks.py", "solutions/solution_a.py", "recordings/plate_pymunk.json"):
            for path in [f"{root}/{name}", *glob.glob(f"{root}/0*/{name}"), *glob.glob(f"{root}/*/0*/{name}")]:
                try:
                    open(path).read()
                except OSError:
                    continue
                raise RuntimeError("BREACH read " + path)
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
