"""`grade`: finds the submissions, grades those that are not finished, and writes all that goes out."""

import dataclasses
from collections import Counter
from pathlib import Path

import exercises
from exercises.grader.classroom import (
    cases,
    exports,
    feedback,
    overview,
    results,
    roster,
    scores,
    similarity,
    submissions,
)
from exercises.grader.classroom.batch import Batch
from exercises.grader.classroom.files import write

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
    batch = Batch(store, drawn, options, tell)
    batch.run(found)
    for line in _changes_told(batch.changes, options):
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
