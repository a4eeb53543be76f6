# Attack: secrets in the environment and in the command line.
# %%
import os
import sys


def attack(*arguments):
    words = " ".join([*os.environ, *os.environ.values(), *sys.argv, *sys.orig_argv]).upper()
    for word in ("SECRET", "TOKEN", "PASSWORD", "SEED", "KEY=", "SSH_", "PYTEST", "ANSWERS", "/CHECKS"):
        if word in words:
            raise RuntimeError("BREACH " + word)
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
