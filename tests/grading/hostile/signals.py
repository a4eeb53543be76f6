# Attack: signals to the parent, to the group, to all.
# %%
import ctypes
import os
import signal

libc = ctypes.CDLL(None, use_errno=True)


def attack(*arguments):
    for pid in (os.getppid(), 0, -1, 1, -os.getpgrp()):
        for number in (0, signal.SIGCONT, signal.SIGTERM, signal.SIGKILL, signal.SIGSTOP):
            try:
                os.kill(pid, number)
            except OSError:
                continue
            raise RuntimeError(f"BREACH signal {number} to {pid}")
    if libc.syscall(434, os.getppid(), 0) >= 0 or libc.syscall(200, os.getppid(), 0) == 0:
        raise RuntimeError("BREACH by a file descriptor of a process, or tkill")
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
