# Attack: looks for expected values in the frames below the call.
# %%
import sys


def attack(*arguments):
    frame = sys._getframe(1)
    while frame is not None:
        for name, value in {**frame.f_globals, **frame.f_locals}.items():
            if any(word in str(name).lower() for word in ("expect", "oracle", "verdict", "judge", "answers")):
                raise RuntimeError("BREACH " + name)
        frame = frame.f_back
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
