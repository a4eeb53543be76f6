"""What stands where: the tracked files, the sixteen units, their pages and the modules they name."""

import ast
import re
import subprocess
from pathlib import Path, PurePosixPath

import yaml

ROOT = Path(__file__).resolve().parents[2]

# The slides of the lecture (SYLLABUS.md, given with the design, not part of the repository; it has no S19).
SLIDES = {f"S{n}" for n in range(3, 25)} - {"S19"}

# The table of units in DESIGN.md: the slug and the slides that the unit must serve.
UNITS = {
    "01_taxonomy": {"S3"},
    "02_equation_of_motion": {"S4", "S9"},
    "03_jacobian": {"S5", "S6", "S7"},
    "04_embedding": {"S8", "S9"},
    "05_contact": {"S10", "S11", "S12"},
    "06_pivoting_lcp": {"S13", "S14"},
    "07_iterative_lcp": {"S14", "S15", "S16", "S17"},
    "08_newton_lcp": {"S14"},
    "09_error_correction": {"S13"},
    "10_simulators_compared": {"S3", "S12", "S18"},
    "11_from_time_to_space": {"S20"},
    "12_representative_points": {"S21"},
    "13_finite_elements": {"S20", "S22"},
    "14_cloth": {"S23"},
    "15_fluid_grid": {"S20", "S24"},
    "16_particles": {"S21", "S24"},
}


def tracked(root, *suffixes):
    """The files of the repository, committed or about to be, sorted; what git ignores is left out."""
    root = Path(root)
    names = _from_git(root) if (root / ".git").exists() else None
    if names is None:  # unpacked from an archive: all but the folders that git would ignore
        ignored = {".git", ".venv", "work", "build", "__pycache__"}
        names = [p.relative_to(root).as_posix() for p in root.rglob("*") if not ignored & set(p.parts)]
    files = sorted(PurePosixPath(name) for name in names if (root / name).is_file())
    return [file for file in files if not suffixes or file.suffix in suffixes]


def _from_git(root):
    command = ["git", "-C", str(root), "ls-files", "-co", "--exclude-standard", "-z"]
    try:
        done = subprocess.run(command, capture_output=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return [name for name in done.stdout.decode().split("\0") if name]


def text(root, file):
    """The text of a tracked file, or None where it is not text."""
    data = (Path(root) / file).read_bytes()
    try:
        return None if b"\0" in data else data.decode("utf-8")
    except UnicodeDecodeError:
        return None


def pages(root):
    """The lecture pages that exist: slug -> path relative to the root."""
    return {
        slug: PurePosixPath("lectures", f"{slug}.md")
        for slug in UNITS
        if (Path(root) / f"lectures/{slug}.md").is_file()
    }


def notebook_of(slug):
    return PurePosixPath("notebooks", f"{slug}.ipynb")


def exercise_of(slug):
    return PurePosixPath("exercises", slug, f"{slug}.ipynb")


def front_matter(root, page):
    """The YAML block that opens a page, as a dict ({} where there is none that can be read)."""
    found = re.match(r"---\n(.*?)\n---\n", text(root, page) or "", re.DOTALL)
    try:
        block = yaml.safe_load(found.group(1)) if found else {}
    except yaml.YAMLError:
        return {}
    return block if isinstance(block, dict) else {}


def module_file(root, name):
    """`simulators/smooth` or `simulators` -> the file that holds it, relative to the root, or None."""
    name = str(name).strip("/").removesuffix(".py")
    for file in (PurePosixPath("reference", f"{name}.py"), PurePosixPath("reference", name, "__init__.py")):
        if (Path(root) / file).is_file():
            return file
    return None


def page_modules(root, page):
    """The module files that a page's front matter lists."""
    listed = front_matter(root, page).get("modules") or []
    return [file for name in listed if (file := module_file(root, name))]


def module_name(file):
    """reference/simulators/smooth.py -> reference.simulators.smooth"""
    parts = PurePosixPath(file).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def parse(root, file):
    return ast.parse(text(root, file), filename=str(file))


def slides_in(words):
    """The slides that a text names: `S4`, `S5-S7` and `S5–7` alike."""
    named = set()
    for first, last in re.findall(r"\bS(\d+)(?:\s*[-–]\s*S?(\d+))?\b", words):
        named |= {f"S{n}" for n in range(int(first), int(last or first) + 1)}
    return named
