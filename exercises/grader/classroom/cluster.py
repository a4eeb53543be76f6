"""Jobs on a Dask cluster (reference/cluster.py says how to start one): JSON text there and back.

Before it gets a submission, each worker shows by the canary that its sandbox holds.
"""

import functools
import json
import threading
from pathlib import Path

import exercises
from exercises.grader.classroom import job, workers
from exercises.grader.classroom.files import Trouble, line
from reference import cluster

ONE_AT_A_TIME = threading.Lock()  # a process has one sandbox, whatever threads it has


def run(payloads, address, tell=print, unsafe=False):
    """(key, result's text) as they get done. `payloads` yields (key, text)."""
    try:
        with cluster.connect(address) as client:
            kinds = _isolations(client)
            for worker, (kind, reason) in kinds.items():
                if kind == "none" and not unsafe:
                    raise Trouble(
                        f"The worker {line(worker)} has no sandbox that holds: {line(reason, 400)}."
                    )
            tell(f"{len(kinds)} workers: {', '.join(sorted({kind for kind, _ in kinds.values()}))}.")
            task = functools.partial(grade, folder=str(exercises.FOLDER))
            for key, future in cluster.finished(client, task, payloads):
                yield key, _text(future)
    except cluster.ClusterError as error:
        raise Trouble(line(error, 400)) from None


def grade(text, folder):
    """What a task is, in a worker of the cluster."""
    with ONE_AT_A_TIME:
        if str(exercises.FOLDER) != folder and Path(folder).is_dir():
            job.use_exercises(folder)
        return job.grade(text)


def canary():
    """A worker's word on its sandbox, as text."""
    with ONE_AT_A_TIME:
        return json.dumps(workers.probe())


def _isolations(client):
    """{worker: (kind of isolation, why no other)}"""
    asked = {
        address: client.submit(canary, key=f"canary-{i}", workers=[address], pure=False)
        for i, address in enumerate(client.nthreads())
    }
    return {address: json.loads(future.result()) for address, future in asked.items()}


def _text(future):
    """The task's answer. A task that killed its workers again and again is our failure, not the student's."""
    try:
        return future.result()
    except Exception as error:
        return json.dumps(job.grader_error(f"the cluster lost it: {type(error).__name__}"))
