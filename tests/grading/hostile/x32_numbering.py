# Attack: system calls with the x32 bit.
# %%
import ctypes


def attack(*arguments):
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.syscall(ctypes.c_long(0x40000000 + 57)) >= 0:
        raise RuntimeError("BREACH x32")
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
