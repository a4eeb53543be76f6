# Attack: keeps what it was asked in one question for the next, in memory and in files.
# %%
import os
import tempfile

SEEN = []


def attack(*arguments):
    names = [name for folder in (".", tempfile.gettempdir(), "/tmp") if os.path.isdir(folder)
             for name in _names(folder)]
    if any(name.startswith("seen") for name in names):
        raise RuntimeError("BREACH a file of an earlier question")
    SEEN.append(arguments)
    return 0.0


def _names(folder):
    try:
        return os.listdir(folder)
    except OSError:
        return []


def keep(*arguments):
    open("seen.txt", "w").write(repr(SEEN))
    return 0.0


plate = gyrostat_rate = kutta_step = flip_time = attack
body_rate = air_force = march = swing = keep
