"""`check("name")` in a notebook: looks at the functions that the notebook holds now, and prints a report.

Grader and worker sit in one process here, and talk in the same text as over a pipe: so a reply that could not
cross the pipe does not pass here either.
"""

import sys

import exercises
from exercises.grader.marking import mark_in_turn
from exercises.grader.report import report, total
from exercises.grader.worker import Worker


class NotebookCheck:
    """The `check` of one unit."""

    def __init__(self, unit):
        self.unit = unit

    def __call__(self, name=None):
        checks = exercises.part(
            self.unit, "checks"
        ).CHECKS  # imported at the first check: engines take a moment
        names = [check.name for check in checks]
        if name is not None and name not in names:
            print(f"There is no check {name!r}. There is: {', '.join(names)}; check() does them all.")
            return
        worker = Worker(sys._getframe(1).f_globals, exercises.part(self.unit, "given"))
        asked = [check for check in checks if name in (None, check.name)]
        before = [check for check in checks if name is not None and check.name in asked[0].after]
        results = []
        for result in mark_in_turn([*before, *asked], worker.answer):
            if result.check in asked:
                results.append(result)
                print(report(result, page(self.unit)), flush=True)
        if name is None:
            print(total(results))

    def __repr__(self):
        return f'the checks of unit {self.unit}: check("name") for one, check() for all'


def page(unit):
    return f"lectures/{unit}.md"
