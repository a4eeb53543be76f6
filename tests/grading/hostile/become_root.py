# Attack: takes privileges: users, capabilities, namespaces.
# %%
import ctypes
import os

libc = ctypes.CDLL(None, use_errno=True)


def attack(*arguments):
    if os.getuid() == 0:
        raise RuntimeError("BREACH runs as root")
    for act in (lambda: os.setuid(0), lambda: os.setgid(0), lambda: os.setgroups([0]), lambda: os.chroot(".")):
        try:
            act()
        except OSError:
            continue
        raise RuntimeError("BREACH")
    for flags in (0x10000000, 0x10020000, 0x40000000, 0x20000000):
        if libc.unshare(flags) == 0:
            raise RuntimeError("BREACH a namespace")
    for option, value in ((38, 0), (4, 0), (22, 0), (8, 1), (47, 2), (1, 0), (36, 1)):
        if libc.prctl(option, value, 0, 0, 0) == 0:
            raise RuntimeError(f"BREACH prctl {option}")
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
