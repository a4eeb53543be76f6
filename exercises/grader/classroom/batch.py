"""The submissions that are not finished: each is read, graded, and its result kept at once.

Notebooks are read when their turn comes, so that the grader holds a few at a time, not a class.
"""

import dataclasses
import datetime
import json

import exercises
from exercises.grader.classroom import cases, job, local, results, submissions, workers
from exercises.grader.classroom.files import digest
from exercises.grader.classroom.progress import Progress


@dataclasses.dataclass
class Change:
    """What --regrade did to one score."""

    submission: object
    old: dict
    new: dict
    kept: bool = False


class Batch:
    """`drawn` holds the hidden cases of each unit, as text. `changes` lists the Changes, once it has run."""

    def __init__(self, store, drawn, options, tell):
        self.store, self.drawn, self.options, self.tell = store, drawn, options, tell
        self.waiting, self.refusals, self.marks, self.changes = {}, {}, {}, []

    def run(self, found):
        """Grades all of `found` that is not finished."""
        self._sort_out(found)
        count = len(self.waiting) + len(self.refusals)
        if not count:
            return
        self.tell(f"{count} submissions to grade.")
        self.progress = Progress(count, "graded")
        for one, why in self.refusals.values():
            self._keep(one, refused(one.unit, why))
        if self.waiting:
            for key, text in self._results():
                self._keep(self.waiting[key], json.loads(text))

    def _sort_out(self, found):
        """What is to be graded, and what cannot be read."""
        stale = 0
        for one in found:
            if one.path is None and not one.refused:
                continue  # missing
            notebook, why = _read(one)
            self.marks[one.key], old = digest(notebook + why.encode()), self.store.read(one)
            if results.finished(old, self.marks[one.key]) and not self.options.regrade:
                stale += (old["checks_hash"], old["cases"]) != self._made_with(one.unit)
            elif why:
                self.refusals[one.key] = one, why
            else:
                self.waiting[one.key] = one
        if stale:
            made = "were made with other checks or another seed"
            self.tell(f"Note: {stale} finished results {made}; --regrade renews them.")

    def _made_with(self, unit):
        return cases.check_hash(unit), digest(self.drawn[unit])[:16]

    def _payloads(self):
        for key, one in self.waiting.items():
            notebook, _ = _read(one)  # nothing, if it has gone meanwhile: the sandbox rejects that
            self.marks[key] = digest(notebook)
            yield (
                key,
                job.payload(
                    one.unit,
                    notebook,
                    self.drawn[one.unit],
                    workers.of_starter(one.unit),
                    self.options.unsafe,
                ),
            )

    def _results(self):
        """(key, result's text), here or on a cluster."""
        if self.options.scheduler:
            from exercises.grader.classroom import cluster

            return cluster.run(self._payloads(), self.options.scheduler, self.tell, self.options.unsafe)
        kind, reason = workers.probe()
        if kind == "none" and not self.options.unsafe:
            raise workers.sandbox.NoSandbox(reason)
        if self.options.jobs == 1:
            for unit, text in self.drawn.items():
                job.work_out(unit, text)
        return local.run(self._payloads(), self.options.jobs, exercises.FOLDER)

    def _keep(self, one, result):
        checks_hash, case_digest = self._made_with(one.unit)
        result.update(
            notebook=self.marks[one.key],
            checks_hash=checks_hash,
            cases=case_digest,
            graded=datetime.datetime.now().astimezone().isoformat(timespec="seconds"),
        )
        old = self.store.read(one)
        same = old is not None and old.get("notebook") == result["notebook"]
        change = Change(one, old, result)
        if same and results.is_lower(old, result) and not self.options.allow_lower:
            change.kept = True
            self.store.note(one, old, result, "kept the old one: the new one is lower")
        else:
            self.store.write(one, result)
        if same:
            self.changes.append(change)
        self.progress.step(result["status"])


def _read(one):
    """(the notebook's bytes, why it is refused)"""
    if one.refused:
        return b"", one.refused
    try:
        return submissions.read(one.path), ""
    except submissions.Refused as error:
        return b"", str(error)


def refused(unit, why):
    """The result of a file that was not even read."""
    checks = [job.nothing(check) for check in exercises.part(unit, "checks").CHECKS]
    about = {"status": "rejected", "reason": why, "troubles": [], "environment": job.environment()}
    return {**about, "checks": checks}
