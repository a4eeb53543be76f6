"""Jobs on a Dask cluster: one task a submission, JSON text there and back.

    dask scheduler --host 127.0.0.1 --port 8786                        on one machine
    dask worker tcp://127.0.0.1:8786 --nworkers 8 --nthreads 1         in the course's folder, on each

Over a network only TLS will do: the tasks hold the hidden cases. A worker that dies loses nothing: what it had
in hand is done again by another. Each result is taken once.
"""

import ipaddress
import json
import re
import threading
from pathlib import Path

import exercises
from exercises.grader.classroom import job, workers
from exercises.grader.classroom.files import Trouble, digest, line

AHEAD = 4  # tasks for each thread of the cluster that wait there, so that no worker idles
RETRIES = 3  # by Dask, where a task raised; ours never do, so it is the machine's fault
LEAST_WORKERS = 1
ONE_AT_A_TIME = threading.Lock()
PATIENCE = 60.0  # seconds until a scheduler must answer, and until the first worker must be there


def run(payloads, address, tell=print, unsafe=False):
    """(key, result's text) as they get done. `payloads` yields (key, text)."""
    require_safe(address)
    try:
        from distributed import Client, as_completed
    except ImportError:
        raise Trouble("--scheduler needs Dask: install the packages of environment.txt.") from None
    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, TimeoutError) as error:
        raise Trouble(f"The scheduler {line(address)} does not answer: {line(error)}.") from None
    with client:
        threads = _ready(client, unsafe, tell)
        payloads, keys, done = iter(payloads), {}, set()

        def submit():
            one = next(payloads, None)
            if one is None:
                return None
            name = f"grade-{len(keys)}-{digest(one[1])[:16]}"  # says nothing of whose it is
            future = client.submit(grade, one[1], str(exercises.FOLDER), key=name, pure=False, retries=RETRIES)
            keys[name] = one[0]
            return future

        first = [future for _ in range(AHEAD * threads) if (future := submit()) is not None]
        finished = as_completed(first, loop=client.loop)
        for future in finished:
            if future.key not in done:
                done.add(future.key)
                yield keys[future.key], _text(future)
            if (following := submit()) is not None:
                finished.add(following)


def require_safe(address):
    """Loopback, or TLS: anything else lets the network read the hidden cases and forge results."""
    found = re.fullmatch(r"(tcp|tls)://(\[[0-9a-fA-F:]+\]|[\w.-]+):\d{1,5}", address)
    if not found:
        raise Trouble(f"--scheduler {line(address)}: write tls://HOST:PORT, or tcp://127.0.0.1:PORT.")
    scheme, host = found.groups()
    if scheme == "tls" or host == "localhost":
        return
    try:
        if ipaddress.ip_address(host.strip("[]")).is_loopback:
            return
    except ValueError:
        pass
    raise Trouble(f"--scheduler {line(address)}: beyond this machine only TLS will do, since the tasks hold the "
                  "hidden cases: tls://HOST:PORT, with the certificates in Dask's own settings "
                  "(distributed.comm.tls).")


def grade(text, folder):
    """What a task is, in a worker of the cluster. A process has one sandbox, whatever threads it has."""
    with ONE_AT_A_TIME:
        if str(exercises.FOLDER) != folder and Path(folder).is_dir():
            job.use_exercises(folder)
        return job.grade(text)


def canary():
    """A worker's word on its sandbox, as text: run there before it gets a submission."""
    with ONE_AT_A_TIME:
        return json.dumps(workers.probe())


def _ready(client, unsafe, tell):
    """How many threads the cluster has, once each worker has shown that its sandbox holds."""
    try:
        client.wait_for_workers(LEAST_WORKERS, timeout=PATIENCE)
    except TimeoutError:
        raise Trouble("The scheduler has no worker: start one, with `dask worker ADDRESS`.") from None
    kinds = {}
    asked = {
        address: client.submit(canary, key=f"canary-{i}", workers=[address], pure=False)
        for i, address in enumerate(client.nthreads())
    }
    for address, future in asked.items():
        kind, reason = json.loads(future.result())
        if kind == "none" and not unsafe:
            raise Trouble(f"The worker {line(address)} has no sandbox that holds: {line(reason, 400)}.")
        kinds[address] = kind
    tell(f"{len(kinds)} workers: {', '.join(sorted(set(kinds.values())))}.")
    return max(1, sum(client.nthreads().values()))


def _text(future):
    """The task's answer. A task that killed its workers again and again is our failure, not the student's."""
    try:
        return future.result()
    except Exception as error:
        return json.dumps(job.grader_error(f"the cluster lost it: {type(error).__name__}"))
