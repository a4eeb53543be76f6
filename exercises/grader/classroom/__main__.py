"""The commands of a class: grade, collect, release. `course.py` hands its arguments on to this.

python -m exercises.grader.classroom grade FOLDER [OPTIONS]
"""

import argparse
import os
import sys
from pathlib import Path

import exercises
from exercises.grader.check import SELF_STUDY_SEED
from exercises.grader.classroom.files import Trouble, line
from exercises.grader.classroom.local import default_jobs

BUILD = Path(exercises.__file__).resolve().parents[1] / "build"


def main(arguments=None):
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="replace")  # a console that cannot show a letter must not stop us
    if "COURSE_FROM" in os.environ:
        os.chdir(
            os.environ["COURSE_FROM"]
        )  # course.py runs in its own folder; paths are seen from the user's
    options = _parser().parse_args(arguments)
    try:
        if options.exercises:
            _use(options.exercises)
        return options.command(options) or 0
    except Trouble as trouble:
        print(trouble, file=sys.stderr)
    except KeyboardInterrupt:
        print("\nInterrupted. What is graded is kept; the same command goes on from there.", file=sys.stderr)
        return 130
    return 2


def _use(folder):
    if not any((path / "checks.py").is_file() for path in folder.glob("*/")):
        raise Trouble(f"--exercises {folder}: it holds no <unit>/checks.py.")
    exercises.FOLDER = folder.resolve()


def grade(options):
    if not sys.platform.startswith("linux"):
        raise Trouble(
            "A class is graded on Linux, whose kernel holds the sandbox. On Windows use WSL2, on macOS the "
            "container of exercises/grader/Containerfile: lectures/instructors.md says how."
        )
    from exercises.grader.classroom.run import Options
    from exercises.grader.classroom.run import grade as grade_class
    from exercises.grader.sandbox import NoSandbox

    try:
        scores = grade_class(
            Options(
                folder=options.folder.resolve(),
                out=options.out and options.out.resolve(),
                units=tuple(_slug(unit) for unit in options.unit),
                seed=options.seed,
                jobs=options.jobs,
                scheduler=options.scheduler,
                unsafe=options.unsafe_no_sandbox,
                regrade=options.regrade,
                allow_lower=options.allow_lower,
                anonymous=options.anonymous,
                canvas=options.canvas,
                moodle=options.moodle,
            )
        )
    except NoSandbox as error:
        raise Trouble(
            f"{error}\nNothing was graded. --unsafe-no-sandbox grades all the same: whatever a student "
            "wrote then runs as you, and every result says so."
        ) from None
    return 1 if any(score.status == "grader_error" for score in scores) else 0


def collect(options):
    from exercises.grader.classroom.collect import collect as unpack
    from exercises.grader.classroom.roster import read_roster

    folder = options.out.resolve()
    written, notes = unpack(options.zip, folder, read_roster(folder), options.unit and _slug(options.unit))
    for note in notes:
        print(f"Note: {line(note, 400)}.")
    print(f"{written} new notebooks in {folder / 'submitted'}.")


def release(options):
    from exercises.grader.classroom.release import release as make

    for path in make(options.out.resolve()):
        print(path)


def _slug(text):
    try:
        return exercises.slug(text)
    except ValueError as error:
        raise Trouble(f"{error}.") from None


def _seed(text):
    if not text.isdecimal() or len(text) > 60:
        raise argparse.ArgumentTypeError(f"{line(text)!r} is not a whole number of 0 or more")
    return int(text)


def _jobs(text):
    if not text.isdecimal() or not 1 <= int(text) <= 256:
        raise argparse.ArgumentTypeError(f"{line(text)!r} is not a number from 1 to 256")
    return int(text)


def _parser():
    parser = argparse.ArgumentParser(prog="course.py", description=__doc__.split("\n")[0])
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    def command(function, summary, epilog=None):
        told = summary[0].upper() + summary[1:] + "."
        added = commands.add_parser(function.__name__, help=summary, epilog=epilog, description=told)
        added.set_defaults(command=function)
        _path(added, "--exercises", "DIR", "your own units, laid out as exercises/ is")
        return added

    _grade_options(command(
        grade,
        "grade FOLDER/submitted/<student>/<unit>/*.ipynb: scores.csv, feedback, an overview",
        "Beside submitted/ you may put roster.csv, deadlines.csv, manual.csv: see lectures/instructors.md. "
        "The same command after an interruption goes on where it stopped.",
    ))  # fmt: skip
    added = command(collect, "unpack a download from Canvas or Moodle into submitted/<student>/<unit>/")
    _path(added, "zip", "ZIP")
    _path(added, "--out", "FOLDER", "the class's folder, with its roster.csv (default: here)", Path("."))
    added.add_argument("--unit", help="which unit it is, if the files' names don't tell")
    added = command(release, "make the students' copy: no solutions, oracles, generators or seeds")
    _path(added, "--out", "DIR", "default: build/release in the course's folder", BUILD / "release")
    return parser


def _path(parser, name, metavar, told=None, default=None):
    parser.add_argument(name, type=Path, metavar=metavar, help=told, default=default)


def _grade_options(parser):
    jobs = default_jobs()
    cluster = "send the submissions to a Dask cluster: tls://HOST:PORT, or tcp://127.0.0.1:PORT"
    seed = (
        "draw the hidden cases from N; without it from 128 secret bits, drawn on first use and kept with the "
        f"results. {SELF_STUDY_SEED} is the students' own, of notebook and shell"
    )
    _path(parser, "folder", "FOLDER")
    _path(parser, "--out", "DIR", "where the results go (default: FOLDER)")
    parser.add_argument("--unit", action="append", default=[], help="grade only this unit; may be repeated")
    parser.add_argument("--seed", type=_seed, metavar="N", help=seed)
    parser.add_argument(
        "--jobs", type=_jobs, default=jobs, metavar="N", help=f"submissions at a time (default: {jobs})"
    )
    parser.add_argument("--scheduler", metavar="ADDRESS", help=cluster)
    for name, told in (
        ("--regrade", "grade all anew, and list old → new"),
        ("--allow-lower", "let --regrade lower a score"),
        ("--anonymous", "numbers in place of names in the overview"),
        ("--unsafe-no-sandbox", "grade even where no sandbox works; stamped into every result"),
    ):
        parser.add_argument(name, action="store_true", help=told)
    _path(parser, "--canvas", "CSV", "a gradebook exported from Canvas, to be filled")
    _path(parser, "--moodle", "CSV", "a gradebook exported from Moodle, to be filled")


if __name__ == "__main__":
    sys.exit(main())
