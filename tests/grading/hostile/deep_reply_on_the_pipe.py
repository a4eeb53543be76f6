# Attack: writes nested JSON itself.
# %%
import os


def attack(*arguments):
    data = b"[" * 3_000_000 + b"]" * 3_000_000 + b"\n"
    while data:
        data = data[os.write(4, data) :]
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
