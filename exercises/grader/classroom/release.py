"""`release`: what students get. Visible answers as data; no oracle, generator, solution or seed.

OUT/release/<unit>/<unit>.ipynb     as nbgrader hands it out: with nbgrader's metadata
OUT/course.zip                      the course, with checks that read the visible answers
"""

import io
import json
import re
import zipfile
from pathlib import Path

import exercises
from exercises.grader.classroom.files import write
from exercises.grader.released import as_data

KEPT_BACK = {"recordings.py"}  # of exercises/grader/: what oracles are made of
TOP = ("README.md", "LICENSE", "course.py", "environment.txt", "pyproject.toml", ".gitignore")
FOLDERS = ("lectures", "notebooks", "reference")
KINDS = {".md", ".py", ".ipynb", ".json", ".svg", ".png", ".csv", ".txt", ".css"}
FOR_INSTRUCTORS = {"lectures/instructors.md", "lectures/authors.md"}
READS_DATA = '''"""The visible checks of this unit. In class, they are made on further cases too."""

from pathlib import Path

from exercises.grader.released import read

CHECKS = read(Path(__file__).with_name("checks.json"))
'''


def release(out):
    """Writes the bundle; yields what was written."""
    for unit in exercises.units():
        path = out / "release" / unit / f"{unit}.ipynb"
        write(path, notebook(unit))
        yield path
    path = out / "course.zip"
    write(path, _zip(dict(bundle())))
    yield path


def bundle():
    """(name, bytes) of every file of the students' course."""
    root = Path(exercises.__file__).resolve().parents[1]
    for name in TOP:
        path = root / name
        if path.is_file():
            yield name, for_students(path) if path.suffix == ".md" else path.read_bytes()
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            name = path.relative_to(root).as_posix()
            hidden = any(part.startswith((".", "__pycache__")) for part in path.relative_to(root).parts)
            if path.is_file() and path.suffix in KINDS and name not in FOR_INSTRUCTORS and not hidden:
                yield name, for_students(path) if path.suffix == ".md" else path.read_bytes()
    yield "exercises/__init__.py", (root / "exercises" / "__init__.py").read_bytes()
    for path in sorted((root / "exercises" / "grader").glob("*.py")):
        if path.name not in KEPT_BACK:
            yield f"exercises/grader/{path.name}", path.read_bytes()
    for unit in exercises.units():
        yield from _unit(unit)


def for_students(path):
    """A page without what is an instructor's: their section, and lines of lists that lead to their pages."""
    text = path.read_text(encoding="utf-8")
    text = re.sub(r"^## If you are an instructor\n.*?(?=^## )", "", text, flags=re.MULTILINE | re.DOTALL)
    names = "|".join(re.escape(Path(name).name) for name in FOR_INSTRUCTORS)
    return re.sub(rf"^- \[.*\]\((?:lectures/)?(?:{names})\).*\n", "", text, flags=re.MULTILINE).encode(
        "utf-8"
    )


def _unit(unit):
    folder = exercises.FOLDER / unit
    checks = [as_data(check) for check in exercises.part(unit, "checks").CHECKS]
    text = json.dumps({"unit": unit, "checks": checks}, allow_nan=False, indent=1, ensure_ascii=False) + "\n"
    yield f"exercises/{unit}/{unit}.ipynb", (folder / f"{unit}.ipynb").read_bytes()
    yield f"exercises/{unit}/given.py", (folder / "given.py").read_bytes()
    yield f"exercises/{unit}/checks.json", text.encode("utf-8")
    yield f"exercises/{unit}/checks.py", READS_DATA.encode("utf-8")


def _zip(files):
    """The same files make the same bytes, whenever and wherever."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sorted(files):
            about = zipfile.ZipInfo(f"course/{name}", (2020, 1, 1, 0, 0, 0))
            about.external_attr = (0o755 if name == "course.py" else 0o644) << 16
            about.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(about, files[name])
    return out.getvalue()


def notebook(unit):
    """The starter as nbgrader marks it: `check("x")` is graded, the function before it is to write."""
    book = json.loads((exercises.FOLDER / unit / f"{unit}.ipynb").read_text(encoding="utf-8"))
    points = {check.name: check.points for check in exercises.part(unit, "checks").CHECKS}
    for cell in book["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] != "code":
            continue
        if (found := re.fullmatch(r'\s*check\("(\w+)"\)\s*', source)) and found[1] in points:
            _mark(cell, found[1], grade=True, points=points[found[1]])
        elif (found := re.match(r"def (\w+)\(", source)) and source.rstrip().endswith("..."):
            _mark(cell, f"cell-{found[1]}", solution=True)
    return json.dumps(book, indent=1, ensure_ascii=False) + "\n"


def _mark(cell, name, grade=False, solution=False, **more):
    about = {"grade": grade, "solution": solution, "locked": grade, "task": False, "grade_id": name}
    cell["metadata"]["nbgrader"] = {**about, **more, "schema_version": 3, "cell_type": "code"}
