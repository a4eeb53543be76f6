# Attack: imports the checks, the answers and the engines' side.
# %%
import importlib

import exercises

found = []
for name in ("exercises.grader.check", "exercises.grader.judges", "exercises.grader.marking",
             "exercises.02_equation_of_motion.answers", "exercises.02_equation_of_motion.checks"):
    try:
        found.append(importlib.import_module(name).__file__)
    except Exception:
        pass
for name in ("answers", "checks", "engines"):
    try:
        found.append(exercises.part("02", name).__file__)
    except Exception:
        pass


def attack(*arguments):
    if found:
        raise RuntimeError("BREACH " + str(found))
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
