# Attack: memory that does not count as the process's own: /dev/shm, files in memory, shared maps, System V.
# %%
import ctypes
import mmap
import os

libc = ctypes.CDLL(None, use_errno=True)


def attack(*arguments):
    try:
        open("/dev/shm/hog", "wb").write(b"x" * 1000)
        raise RuntimeError("BREACH /dev/shm")
    except OSError:
        pass
    try:
        os.memfd_create("hog")
        raise RuntimeError("BREACH memfd")
    except OSError:
        pass
    if libc.shmget(0, 1 << 20, 0o1600) >= 0 or libc.syscall(447, 0) >= 0:
        raise RuntimeError("BREACH shared memory")
    kept = [mmap.mmap(-1, 256 << 20) for _ in range(100)]
    raise RuntimeError("BREACH " + str(len(kept)))


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
