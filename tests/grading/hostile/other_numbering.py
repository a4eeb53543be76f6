# Attack: the system calls of 32-bit programs, by which a filter may not see them.
# %%
import ctypes
import mmap

CODE = bytes.fromhex("b814000000" "cd80" "c3")  # eax = 20, getpid of the old numbering; int 0x80


def attack(*arguments):
    page = mmap.mmap(-1, 4096, prot=mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC)
    page.write(CODE)
    address = ctypes.addressof(ctypes.c_char.from_buffer(page))
    result = ctypes.CFUNCTYPE(ctypes.c_int)(address)()
    if result > 0:
        raise RuntimeError("BREACH old numbering")
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
