"""Jobs on this machine: processes, each with a sandbox of its own.

A process that dies, as one may that runs an engine, costs only time: what it had in hand is graded again by
the next; what kills three of them gets the status `grader_error`.
"""

import collections
import concurrent.futures
import json
import multiprocessing
import os
from concurrent.futures.process import BrokenProcessPool

from exercises.grader.classroom import job

MOST_TRIES = 3


def default_jobs():
    """As many as there are processors for us."""
    return max(1, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)


def run(payloads, jobs, folder):
    """(key, result's text) as they get done. `payloads` yields (key, text): only a few wait at a time."""
    if jobs == 1:
        for key, text in payloads:
            yield key, job.grade(text)
        return
    tries, again, payloads = collections.Counter(), [], iter(payloads)
    exhausted = False
    while not exhausted or again:
        waiting = {}
        # spawned, not forked: a fork would share this process's sandbox and its engines
        pool = concurrent.futures.ProcessPoolExecutor(
            jobs, multiprocessing.get_context("spawn"), job.use_exercises, (str(folder),)
        )
        try:
            while True:
                while len(waiting) < 2 * jobs:
                    one = again.pop() if again else next(payloads, None)
                    if one is None:
                        exhausted = True
                        break
                    again.append(one)  # until the pool has it: a broken pool takes nothing
                    future = pool.submit(job.grade, one[1])
                    waiting[future] = again.pop()
                if not waiting:
                    break
                done, _ = concurrent.futures.wait(waiting, return_when=concurrent.futures.FIRST_COMPLETED)
                for future in done:
                    text = future.result()  # BrokenProcessPool: it stays among those that wait
                    yield waiting.pop(future)[0], text
        except BrokenProcessPool:
            for one in waiting.values():
                tries[one[0]] += 1
                if tries[one[0]] < MOST_TRIES:
                    again.append(one)
                else:
                    yield one[0], json.dumps(job.grader_error("the grader's own process died, three times"))
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
