"""Work sent to a Dask cluster: one task an item, text there and text back.

    dask scheduler --host 127.0.0.1 --port 8786                        on one machine
    dask worker tcp://127.0.0.1:8786 --nworkers 8 --nthreads 1         on each; with the course's Python

Beyond one machine only TLS will do: whoever can talk to a scheduler can run anything on its workers. A worker
that dies loses nothing: what it had in hand is done again by another. Each result is taken once.

Serves the sweeps of the benchmark, and the grading of a class. Slides S4, S9, S18;
lectures/02_equation_of_motion.md.
"""

import contextlib
import hashlib
import ipaddress
import re

AHEAD = 4  # tasks for each thread of the cluster that wait there, so that no worker idles
RETRIES = 3  # by Dask, of a task that raised: ours never do, so it is the machine's fault
PATIENCE = 60.0  # seconds until the scheduler must answer, and until its workers must be there
LEAST_WORKERS = 1


class ClusterError(Exception):
    """The cluster cannot be used. The text says what would help."""


def require_safe(address):
    """Raise ClusterError unless the address is TLS, or of this machine: tls://HOST:PORT, tcp://127.0.0.1:PORT."""
    found = re.fullmatch(r"(tcp|tls)://(\[[0-9a-fA-F:]+\]|[\w.-]+):\d{1,5}", address)
    if not found:
        raise ClusterError(f"--scheduler {address[:80]!r}: write tls://HOST:PORT, or tcp://127.0.0.1:PORT.")
    scheme, host = found.groups()
    if scheme == "tls" or host == "localhost":
        return
    with contextlib.suppress(ValueError):
        if ipaddress.ip_address(host.strip("[]")).is_loopback:
            return
    raise ClusterError(
        f"--scheduler {address[:80]!r}: beyond this machine only TLS will do, tls://HOST:PORT, with the "
        "certificates in Dask's own settings (distributed.comm.tls)."
    )


@contextlib.contextmanager
def connect(address):
    """A client of the scheduler at a safe address, once workers are there."""
    require_safe(address)
    try:
        from distributed import Client
    except ImportError:
        raise ClusterError("--scheduler needs Dask: install the packages of environment.txt.") from None
    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, TimeoutError) as error:
        raise ClusterError(f"The scheduler {address} does not answer: {error}.") from None
    with client:
        try:
            client.wait_for_workers(LEAST_WORKERS, timeout=PATIENCE)
        except TimeoutError:
            raise ClusterError(f"The scheduler has no worker: start one, dask worker {address}.") from None
        yield client


def finished(client, function, items):
    """(key, future) of `function(text)`, as they get done, once each; `items` yields (key, text)."""
    from distributed import as_completed

    items, keys, done = iter(items), {}, set()

    def submit():
        one = next(items, None)
        if one is None:
            return None
        name = f"course-{len(keys)}-{hashlib.sha256(one[1].encode()).hexdigest()[:16]}"  # tells nothing
        keys[name] = one[0]
        return client.submit(function, one[1], key=name, pure=False, retries=RETRIES)

    threads = max(1, sum(client.nthreads().values()))
    first = [future for _ in range(AHEAD * threads) if (future := submit()) is not None]
    running = as_completed(first, loop=client.loop)
    for future in running:
        if future.key not in done:
            done.add(future.key)
            yield keys[future.key], future
        if (following := submit()) is not None:
            running.add(following)
