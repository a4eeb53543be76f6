# Odd: prints at length, warns, logs, and shows progress.
# Earns: 100
# %%
import logging
import sys
import warnings

warnings.simplefilter("error")
logging.basicConfig(level=logging.DEBUG)
# %% solution
# %%
silent_step = kutta_step


def kutta_step(rate, t, y, dt):
    print("step", t, y, "\x1b[31m", file=sys.stderr)
    warnings.warn("a warning", stacklevel=1)
    logging.warning("logged")
    return silent_step(rate, t, y, dt)


for i in range(1000):
    print(i, end="\r", flush=True)
