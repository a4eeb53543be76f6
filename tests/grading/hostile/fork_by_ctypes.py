# Attack: forks by raw system calls: fork, vfork, clone, clone3, with and without the parent's children.
# %%
import ctypes

libc = ctypes.CDLL(None, use_errno=True)


def attack(*arguments):
    calls = [(57,), (56, 17, 0, 0, 0, 0), (56, 0x8011, 0, 0, 0, 0), (56, 0x10000011, 0, 0, 0, 0),
             (435, (ctypes.c_ulong * 11)(0, 0, 0, 0, 17), 88)]
    for number, *rest in calls:
        pid = libc.syscall(ctypes.c_long(number), *rest)
        if pid == 0:
            while True:
                pass
        if pid > 0:
            raise RuntimeError("BREACH forked by call " + str(number))
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
