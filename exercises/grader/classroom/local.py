"""Jobs on this machine: processes, each with a sandbox of its own.

A process that dies, as one may that runs an engine, costs only time: what was in hand is graded again, each
by itself, so that only what really kills a process gets the status `grader_error`, and no neighbour of it.
"""

import concurrent.futures
import json
import multiprocessing
import os
import signal
from concurrent.futures.process import BrokenProcessPool

from exercises.grader.classroom import job
from exercises.grader.sandbox import survey

TRIES = 2  # alone, before a submission is given up


def default_jobs():
    """As many as there are processors for us."""
    return max(1, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)


def run(payloads, jobs, folder):
    """(key, result's text) as they get done. `payloads` yields (key, text): only a few wait at a time."""
    if jobs == 1:
        for key, text in payloads:
            yield key, job.grade(text)
        return
    payloads = iter(payloads)
    while True:
        in_hand = yield from _together(payloads, jobs, folder)
        if not in_hand:
            return
        for key, text in in_hand:
            yield key, _alone(text, folder)


def _together(payloads, jobs, folder):
    """Grades all that `payloads` still yields; returns what was in hand when a process died."""
    waiting, handed = {}, None
    pool = _pool(jobs, folder)
    ended = False
    try:
        while True:
            while len(waiting) < 2 * jobs and (handed := next(payloads, None)) is not None:
                waiting[pool.submit(job.grade, handed[1])] = handed
                handed = None
            if not waiting:
                ended = True
                return []
            done, _ = concurrent.futures.wait(waiting, return_when=concurrent.futures.FIRST_COMPLETED)
            for future in done:
                text = future.result()  # if it raises, this one stays among those that wait
                yield waiting.pop(future)[0], text
    except BrokenProcessPool:
        return [*waiting.values(), *([handed] if handed else [])]
    finally:
        pool.shutdown(wait=ended, cancel_futures=True)
        for child in multiprocessing.active_children() if not ended else ():
            child.terminate()  # interrupted: nobody waits for what they have in hand


def _alone(text, folder):
    for _ in range(TRIES):
        with _pool(1, folder) as pool:
            try:
                return pool.submit(job.grade, text).result()
            except BrokenProcessPool:
                continue
    return json.dumps(job.grader_error("the grader's own process died while it graded this, and again"))


def _pool(jobs, folder):
    """Processes that are spawned, not forked: a fork would share this process's sandbox and its engines."""
    context = multiprocessing.get_context("spawn")
    known = survey.survey() if survey.survey.cache_info().currsize else None  # made by the canary, if at all
    return concurrent.futures.ProcessPoolExecutor(jobs, context, _begin, (str(folder), known))


def _begin(folder, known):
    """A new process: Ctrl-C is the affair of the one that started it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    job.use_exercises(folder)
    if known is not None:
        survey.take(known)
