"""Speed against error: our integrators beside pymunk and pybullet, on every case with a known answer.

``python -m reference.bench [CASE…] [--out DIR] [--quick] [--scheduler ADDRESS]``, or ``course.py bench``.

A method is a curve: for each case and method, error against processor seconds as dt falls. What is timed is
``advance`` on a scene that is ready, on all sides: an engine's loop over its steps counts, since that is how
it is used, and setting the scene up does not. The methods of a case take turns, several times, and medians
count, so that a busy moment of the machine meets all of them. Compiling comes before. Errors are those of
separate runs, over up to 64 records. pybullet's substeps are steps that it takes in C++, without going back
to Python. A force that an engine has no word for is computed in Python at each of its steps, the only way to
give it one, and that counts too: on such cases (orbit, heavy top, springs in pybullet) the engine's own part
of the time is small.

A mechanism in a vertical plane is run by both engines: pymunk has it in the plane, pybullet in space.
``links`` is another kind of study: what a step costs as a chain grows. Under each table stands what ``model``
leaves out, since the scene doesn't need it. ``lcp`` compares solvers of the LCP alone (``bench_lcp``).

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import argparse
import json
import sys
from pathlib import Path

from . import cluster
from .bench_contact import CONTACTS
from .bench_contests import CONTESTS
from .bench_growth import GROWTHS
from .bench_lcp import LCP_STUDIES
from .bench_report import HEADING
from .cases.case import Catalogue
from .peers import ENGINES

STUDIES = Catalogue("case", {**CONTESTS, **CONTACTS, **GROWTHS, **LCP_STUDIES})

DEFAULT_OUT = Path(__file__).resolve().parents[1] / "build" / "bench"


def measured(labels, longest, repeats, scheduler=None):
    """(label, rows) of each study, in order; with a scheduler's address, each as one task of its cluster.

    A study stays in one process, so that its methods meet the same machine. On a cluster's worker no other
    task should run: give it one thread, and no neighbour on its processor.
    """
    if scheduler is None:
        for number, label in enumerate(labels, start=1):
            yield label, STUDIES[label].measure(longest, repeats, _progress(f"[{number}/{len(labels)}] "))
        return
    with cluster.connect(scheduler) as client:
        tasks = ((label, json.dumps([label, longest, repeats])) for label in labels)
        rows_of = {}
        for label, future in cluster.finished(client, study_as_text, tasks):
            rows_of[label] = json.loads(future.result())
            print(f"[{len(rows_of)}/{len(labels)}] {label}: measured", file=sys.stderr, flush=True)
    yield from ((label, rows_of[label]) for label in labels)


def study_as_text(text):
    """A study as a task: [label, longest, repeats] in JSON → its rows in JSON."""
    label, longest, repeats = json.loads(text)
    return json.dumps(STUDIES[label].measure(longest, repeats, lambda message: None))


def chosen_labels(names):
    """Studies by their labels, or by a case's name for all of its studies; no names: all of them."""
    if not names:
        return list(STUDIES)
    labels = []
    for name in names:
        of_case = [label for label, study in STUDIES.items() if study.case == name]
        if not of_case:
            STUDIES[name]  # an unknown name raises KeyError with the list
        labels += of_case if name not in STUDIES else [name]
    return labels


def main(arguments=None):
    """Run the studies; table, JSON lines, plots and summary go to a folder, the text to the terminal too."""
    parser = argparse.ArgumentParser(
        prog="bench", description="Speed against error, beside pymunk and pybullet."
    )
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"of {', '.join(STUDIES)}; none: all")
    parser.add_argument("--out", type=Path, default=DEFAULT_OUT, help="output folder (default build/bench)")
    parser.add_argument(
        "--quick", action="store_true", help="short runs, few repeats: a look, no measurement"
    )
    parser.add_argument("--scheduler", metavar="ADDRESS", help="measure on a Dask cluster")
    options = parser.parse_args(arguments)
    try:
        labels = chosen_labels(options.cases)
        if options.scheduler:
            cluster.require_safe(options.scheduler)
    except (KeyError, cluster.ClusterError) as error:
        parser.error(error.args[0])
    for engine in ENGINES.values():
        if not engine.available:
            print(f"{engine.name} is not installed here, and so not compared: {engine.install}")
    longest, repeats = (0.03, 3) if options.quick else (0.2, 5)
    options.out.mkdir(parents=True, exist_ok=True)
    everything, text, compared = [], [], []
    for label, rows in measured(labels, longest, repeats, options.scheduler):
        everything += rows
        text.append(STUDIES[label].table(rows))
        print(text[-1], flush=True)
        STUDIES[label].plot(rows, options.out / f"{label.replace('/', '_')}.png")
        compared += STUDIES[label].summary(rows)
    if compared:
        text.append("\n".join([HEADING, *compared]))
        print(text[-1])
    (options.out / "bench.txt").write_text("\n\n".join(text) + "\n", encoding="utf-8")
    lines = "".join(json.dumps(row) + "\n" for row in everything)
    (options.out / "bench.jsonl").write_text(lines, encoding="utf-8")
    print(f"\nWritten to {options.out}: bench.txt, bench.jsonl and a plot a case.")


def _progress(prefix):
    """A function that shows what is being done, on one line; away from a terminal only that it has begun."""

    def tell(message):
        if sys.stderr.isatty():
            print(f"\r\033[K{prefix}{message}"[:150], end="", file=sys.stderr, flush=True)

    if not sys.stderr.isatty():
        print(prefix + "measuring …", file=sys.stderr, flush=True)
    return tell


if __name__ == "__main__":
    main()
