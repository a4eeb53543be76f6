"""`grade`: finds the submissions, grades those that are not finished, and writes all that goes out."""

import dataclasses
import datetime
import json
from collections import Counter
from pathlib import Path

import exercises
from exercises.grader.classroom import (
    cases,
    exports,
    feedback,
    job,
    local,
    overview,
    results,
    roster,
    scores,
    similarity,
    submissions,
    workers,
)
from exercises.grader.classroom.files import digest, write
from exercises.grader.classroom.progress import Progress

INSTRUCTOR = "instructor"


@dataclasses.dataclass(frozen=True)
class Options:
    folder: Path
    out: Path = None
    units: tuple = ()
    seed: int = None
    jobs: int = 1
    scheduler: str = None
    unsafe: bool = False
    regrade: bool = False
    allow_lower: bool = False
    anonymous: bool = False
    canvas: Path = None
    moodle: Path = None


@dataclasses.dataclass
class Change:
    """What --regrade did to one score."""

    submission: object
    old: dict
    new: dict
    kept: bool = False


def grade(options, tell=print):
    """Grades a class; returns its Scores. Only what the instructor can mend is raised, as Trouble."""
    folder, submitted = submissions.home(options.folder)
    out = options.out or folder
    private = out / INSTRUCTOR
    private.mkdir(parents=True, exist_ok=True)
    private.chmod(0o700)  # the seed, the hidden cases, and who resembles whom
    people = roster.read_roster(folder)
    deadlines, manual = roster.read_deadlines(folder), roster.read_manual(folder)
    found, notes = submissions.find(submitted, people and list(people.students), options.units)
    for note in notes:
        tell(f"Note: {note}.")
    store = results.Results(private)
    seed = cases.class_seed(private, options.seed)
    drawn = {unit: cases.saved_cases(unit, seed, private) for unit in sorted({one.unit for one in found})}
    to_do = list(_to_do(found, store, options.regrade, drawn, tell))
    changes = _grade(to_do, store, drawn, options, tell)
    for line in _changes_told(changes, options):
        tell(line)
    marked = [scores.score(one, store.read(one), _most(one.unit), deadlines, manual) for one in found]
    alike = similarity.pairs(found, store)
    write(out / "scores.csv", scores.scores_table(marked, people))
    feedback.write_all(marked, out / "feedback")
    overview.write_all(marked, alike, people, private, options.anonymous)
    exports.write_all(marked, people, folder, private, options, tell)
    _sum_up(marked, out, tell)
    return marked


def _most(unit):
    return sum(check.points for check in exercises.part(unit, "checks").CHECKS)


def _to_do(found, store, regrade, drawn, tell):
    """(submission, notebook's bytes, its old result) of what is to be graded now."""
    stale = 0
    for one in found:
        if one.path is None and not one.refused:
            continue  # missing
        old = store.read(one)
        try:
            notebook, why = (b"", one.refused) if one.refused else (submissions.read(one.path), "")
        except submissions.Refused as error:
            notebook, why = b"", str(error)
        mark = digest(notebook + why.encode("utf-8", "replace"))
        if results.finished(old, mark) and not regrade:
            stale += (old["checks_hash"], old["cases"]) != _made_with(one.unit, drawn)
            continue
        yield dataclasses.replace(one, refused=why), notebook, old
    if stale:
        tell(
            f"Note: {stale} finished results were made with other checks or another seed; --regrade renews "
            "them."
        )


def _made_with(unit, drawn):
    return cases.check_hash(unit), digest(drawn[unit])[:16]


def _grade(to_do, store, drawn, options, tell):
    """Grades, and keeps each result as soon as it is there. Returns the Changes of --regrade."""
    waiting = {one.key: (one, notebook, old) for one, notebook, old in to_do}
    if not waiting:
        return []
    tell(f"{len(waiting)} submissions to grade.")
    progress, changes = Progress(len(waiting), "graded"), []

    def keep(key, result):
        one, notebook, old = waiting[key]
        checks_hash, case_digest = _made_with(one.unit, drawn)
        result.update(
            notebook=digest(notebook + one.refused.encode("utf-8", "replace")),
            checks_hash=checks_hash,
            cases=case_digest,
            graded=datetime.datetime.now().astimezone().isoformat(timespec="seconds"),
        )
        change = Change(one, old, result)
        same = old is not None and old.get("notebook") == result["notebook"]
        if same and results.is_lower(old, result) and not options.allow_lower:
            change.kept = True
            store.note(one, old, result, "kept the old one: the new one is lower")
        else:
            store.write(one, result)
        if same:
            changes.append(change)
        progress.step(result["status"])

    for key, (one, _, _) in waiting.items():
        if one.refused:
            keep(key, refused(one))
    if any(not one.refused for one, _, _ in waiting.values()):
        for key, text in _run(_payloads(waiting, drawn, options), options, drawn, tell):
            keep(key, json.loads(text))
    return changes


def refused(submission):
    """The result of a file that was not even read."""
    checks = [job.nothing(check) for check in exercises.part(submission.unit, "checks").CHECKS]
    return {
        "status": "rejected",
        "reason": submission.refused,
        "checks": checks,
        "troubles": [],
        "environment": job.environment(),
    }


def _payloads(waiting, drawn, options):
    starters = {unit: workers.starter_cells(unit) for unit in drawn}
    for key, (one, notebook, _) in waiting.items():
        if not one.refused:
            yield key, job.payload(one.unit, notebook, drawn[one.unit], starters[one.unit], options.unsafe)


def _run(payloads, options, drawn, tell):
    if options.scheduler:
        from exercises.grader.classroom import cluster

        return cluster.run(payloads, options.scheduler, tell, options.unsafe)
    kind, reason = workers.probe()
    if kind == "none" and not options.unsafe:
        raise workers.sandbox.NoSandbox(reason)
    if options.jobs == 1:
        for unit, text in drawn.items():
            job.work_out(unit, text)
    return local.run(payloads, options.jobs, exercises.FOLDER)


def _changes_told(changes, options):
    """What --regrade changed, old → new, sorted."""
    shown = 0
    for change in sorted(changes, key=lambda change: change.submission.key):
        old, new = results.earned(change.old), results.earned(change.new)
        if old != new or change.kept:
            shown += 1
            why = f" ({change.new['status']})" if change.new["status"] != "ok" else ""
            kept = "; the old one is kept (--allow-lower lets it fall)" if change.kept else ""
            whose = f"{change.submission.unit}  {change.submission.student}"
            yield f"  {whose}: {_or_blank(old)} → {_or_blank(new)}{why}{kept}"
    if options.regrade:
        yield f"Regraded {len(changes)}: {shown} differ."


def _or_blank(points):
    return "blank" if points is None else points


def _sum_up(marked, out, tell):
    counts = Counter(one.status for one in marked)
    told = ", ".join(
        f"{count} {status}" for status, count in sorted(counts.items(), key=lambda item: -item[1])
    )
    tell(f"{len(marked)} submissions: {told or 'none'}.")
    tell(
        f"Scores: {out / 'scores.csv'}; for the students: {out / 'feedback'}; "
        f"for you: {out / INSTRUCTOR / 'overview.html'}."
    )
    if counts["grader_error"]:
        tell(
            "Where the status is grader_error the fault is ours and the grade is blank; "
            "the same command tries those again."
        )
