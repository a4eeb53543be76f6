"""How much a submission may take, of everything."""

import contextlib
import os
import resource
from dataclasses import asdict, dataclass

THREADS = 64  # of one worker
LONGEST_STRETCH = 3.0


@dataclass(frozen=True)
class Limits:
    """Seconds and bytes. Seconds by the clock are more on an overloaded machine: see `stretch`."""

    cell: float = 10.0  # one cell, in the first worker
    call: float = 10.0  # one call, on average over those of one message
    question: float = 30.0  # all calls of one message; a check has two, of visible and of hidden cases
    total: float = 300.0  # all of a submission
    memory: int = 1 << 30  # what a worker may take beyond what is loaded already
    scratch: int = 64 << 20  # files that it writes
    reply: int = 8_000_000  # bytes of one answer
    notebook: int = 50_000_000  # bytes of the file, pictures and all

    def as_dict(self):
        return asdict(self)


def stretch():
    """How many times longer the clock may run, for an honest cell must not be left out because the machine is
    overloaded: what wants to run, over the processors that there are. CPU time has a limit of its own."""
    wanting = os.getloadavg()[0] / len(os.sched_getaffinity(0))
    return min(LONGEST_STRETCH, max(1.0, wanting))


def confine(limits, loaded, processes):
    """Sets the kernel's limits for this process: `loaded` bytes of addresses are in use already, and
    `processes` is the most that the user may have, threads counted."""
    seconds = int(limits.total) + 2
    ceilings = {
        "RLIMIT_AS": loaded + limits.memory,
        "RLIMIT_CPU": seconds,
        "RLIMIT_FSIZE": limits.scratch,
        "RLIMIT_NPROC": processes,
        "RLIMIT_NOFILE": 128,
        "RLIMIT_CORE": 0,
        "RLIMIT_MEMLOCK": 0,
        "RLIMIT_MSGQUEUE": 0,
        "RLIMIT_SIGPENDING": 128,
        "RLIMIT_NICE": 0,
        "RLIMIT_RTPRIO": 0,
    }
    for name, ceiling in ceilings.items():
        _lower(getattr(resource, name, None), ceiling)


def _lower(number, ceiling):
    if number is None:
        return
    _, hard = resource.getrlimit(number)
    if hard != resource.RLIM_INFINITY:
        ceiling = min(ceiling, hard)
    with contextlib.suppress(OSError, ValueError):
        resource.setrlimit(number, (ceiling, ceiling))
