"""A filter on system calls, written for the kernel's little machine (classic BPF) and set for this process.

What is not listed in syscalls.py is refused with "operation not permitted". Threads are allowed, processes
are not; signals reach this process alone; memory may be made executable, since Numba compiles.
"""

import ctypes
import errno
import functools
import os
import struct

from exercises.grader.sandbox import kernel
from exercises.grader.sandbox.syscalls import (
    ALLOWED,
    GUARDED,
    MACHINES,
    PRETENDED,
    PRETENDED_IF_FLAT,
    UNKNOWN,
    numbers,
)

LOAD, JUMP_EQUAL, JUMP_ABOVE, JUMP_ANY_BIT, RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
ALLOW, KILL, ERROR = 0x7FFF0000, 0x80000000, 0x00050000
NUMBER, ARCHITECTURE, ARGUMENTS = 0, 4, 16  # offsets in what the kernel hands the filter
PROCESS = 0x7FFFABCD  # stands for the process's id until that is known; no process has it
X32 = 0x40000000  # calls of the other, older numbering on x86-64 have this bit

CLONE_THREAD, CLONE_NEW = 0x00010000, 0x7E020080 | 0x00002000  # all new namespaces; and CLONE_PTRACE
FCNTL = (
    0,
    1,
    2,
    3,
    4,
    5,
    6,
    7,
    36,
    37,
    38,
    1030,
    1032,
    1034,
)  # dup, flags, locks, seals read: no owner, no signal
IOCTL = (
    0x5401,
    0x541B,
    0x5421,
    0x5450,
    0x5451,
    0x5413,
)  # TCGETS, FIONREAD, FIONBIO, FIONCLEX, FIOCLEX, TIOCGWINSZ
PRCTL = (3, 15, 16, 21, 39, 0x53564D41)  # read dumpable, thread's name, read seccomp, naming of memory
O_TRUNC, O_TMPFILE = 0o1000, 0o20000000
STREAM = (
    1,
    0x801,
    0x80001,
    0x80801,
)  # pairs of stream sockets: they reach nobody else, as others could by a name


def statement(code, value):
    return (code, 0, 0, value & 0xFFFFFFFF)


def refuse(number=errno.EPERM):
    return statement(RETURN, ERROR | number)


def only_if(number, test):
    """For the call `number` run `test`, which ends in a return; for others go on behind it."""
    return [(JUMP_EQUAL, 0, len(test), number), *test]


def argument(position, high=False):
    return statement(LOAD, ARGUMENTS + 8 * position + (4 if high else 0))


def one_of(position, values):
    """Allow where the argument's low half is one of the values."""
    checks = [(JUMP_EQUAL, len(values) - i, 0, value) for i, value in enumerate(values)]
    return [argument(position), *checks, refuse(), statement(RETURN, ALLOW)]


def thread_only():
    """Allow a clone that makes a thread of this process, in no new namespace."""
    return [
        argument(0),
        (JUMP_ANY_BIT, 2, 0, CLONE_NEW),
        (JUMP_ANY_BIT, 0, 1, CLONE_THREAD),
        statement(RETURN, ALLOW),
        refuse(),
    ]


def no_emptying(position, flat):
    """Allow to open, but not to empty a file while opening it for reading: an older Landlock lets that
    through. In a flat scratch folder no file without a name: none would see how large it is."""
    nameless = [(JUMP_ANY_BIT, 0, 1, O_TMPFILE), refuse(errno.EOPNOTSUPP)] if flat else []
    return [
        argument(position),
        *nameless,
        (JUMP_ANY_BIT, 0, 2, O_TRUNC),
        (JUMP_ANY_BIT, 1, 0, os.O_WRONLY | os.O_RDWR),
        refuse(),
        statement(RETURN, ALLOW),
    ]


def program(machine, process, flat=False):
    """The filter's instructions for a process with this id. `flat`: its scratch folder is one on disk, where
    nothing is removed before the end, so that what it holds can be seen."""
    _, architecture = MACHINES[machine]
    guarded, unknown = numbers(GUARDED, machine), numbers(UNKNOWN, machine)
    lines = [
        statement(LOAD, ARCHITECTURE),
        (JUMP_EQUAL, 1, 0, architecture),
        statement(RETURN, KILL),
        statement(LOAD, NUMBER),
    ]
    if machine == "x86_64":
        lines += [(JUMP_ABOVE, 0, 1, X32), statement(RETURN, KILL)]
    hot = {"open": no_emptying(1, flat), "openat": no_emptying(2, flat)}
    pretended = numbers({**PRETENDED, **(PRETENDED_IF_FLAT if flat else {})}, machine)
    for number in pretended.values():
        lines += only_if(number, [refuse(0)])
    for name, test in hot.items():
        if name in guarded:
            lines += only_if(guarded.pop(name), test)
    for number in numbers(ALLOWED, machine).values():
        lines += only_if(number, [statement(RETURN, ALLOW)])
    for number in unknown.values():
        lines += only_if(number, [refuse(errno.ENOSYS)])
    tests = {
        "clone": thread_only(),
        **dict.fromkeys(("kill", "tgkill", "rt_sigqueueinfo", "rt_tgsigqueueinfo"), one_of(0, (process,))),
        "prlimit64": one_of(0, (0, process)),
        "prctl": one_of(0, PRCTL),
        "fcntl": one_of(1, FCNTL),
        "ioctl": one_of(1, IOCTL),
        "socketpair": one_of(1, STREAM),
    }
    for name, number in guarded.items():
        lines += only_if(number, tests[name])
    return [*lines, refuse()]


class _Program(ctypes.Structure):
    _fields_ = [("length", ctypes.c_ushort), ("instructions", ctypes.c_void_p)]


def supported():
    return kernel.machine() in MACHINES


@functools.cache
def _code(flat):
    """The filter's bytes, made once for all workers, and the places where the process's id is to be put."""
    lines = program(kernel.machine(), PROCESS, flat)
    places = [8 * i + 4 for i, line in enumerate(lines) if line[3] == PROCESS]
    return b"".join(struct.pack("HBBI", *line) for line in lines), len(lines), places


def prepare(flat):
    """Done before the first fork, the costly part is done for all."""
    _code(flat)


def confine(process, flat):
    """From now on, for good, this process (whose id is `process`) can make the listed calls only."""
    code, length, places = _code(flat)
    buffer = ctypes.create_string_buffer(code, len(code))
    for place in places:
        struct.pack_into("I", buffer, place, process)
    kernel.prctl(kernel.PR_SET_NO_NEW_PRIVS, 1)
    filters = _Program(length, ctypes.addressof(buffer))
    kernel.prctl(kernel.PR_SET_SECCOMP, kernel.SECCOMP_MODE_FILTER, ctypes.byref(filters))
