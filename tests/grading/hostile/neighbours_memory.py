# Attack: scans its own memory for code of a neighbour, left there by an earlier submission.
# %%
import ctypes
import os

KRAM = b"NOITULOS_SRUOBHGIEN"  # backwards, since it must not find itself
libc = ctypes.CDLL(None, use_errno=True)
libc.sbrk.restype = ctypes.c_void_p
reading, writing = os.pipe()
libc.write.argtypes = [ctypes.c_int, ctypes.c_void_p, ctypes.c_size_t]


def scan(start, step):
    """Page after page, until one cannot be read."""
    address, last = start, b""
    for _ in range(5_000):
        if libc.write(writing, address, 4096) != 4096:
            return
        page = os.read(reading, 4096)
        if KRAM in (last + page)[::-1] or KRAM in (page + last)[::-1]:
            raise RuntimeError("BREACH a neighbour's code")
        address, last = address + step, page


def attack(*arguments):
    top = libc.sbrk(0) // 4096 * 4096
    scan(top - 4096, -4096)
    for thing in (object(), b"x" * 600, arguments, {}, b"x" * 300_000):
        here = id(thing) // 4096 * 4096
        scan(here, 4096)
        scan(here, -4096)
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
