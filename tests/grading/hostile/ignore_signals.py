# Attack: catches all signals that can be caught, so as not to be stopped, and loops.
# %%
import signal

for number in range(1, 65):
    try:
        signal.signal(number, lambda *rest: None)
    except (OSError, ValueError):
        pass


def attack(*arguments):
    while True:
        pass


plate = attack
plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = lambda *arguments: 0.0
plate = attack
