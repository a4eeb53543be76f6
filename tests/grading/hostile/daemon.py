# Attack: leaves a process behind that goes on when the grader has finished.
# %%
import os
import subprocess
import sys


def attack(*arguments):
    try:
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                while True:
                    pass
            os._exit(0)
    except OSError:
        pass
    for command in ([sys.executable, "-c", "while True: pass"], ["/bin/sh", "-c", "sleep 1000 &"]):
        try:
            subprocess.Popen(command, start_new_session=True)
        except OSError:
            continue
        raise RuntimeError("BREACH started a program")
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
