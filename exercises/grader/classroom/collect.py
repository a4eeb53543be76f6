"""`collect ZIP`: a download from Canvas or Moodle → submitted/<student>/<unit>/<unit>.ipynb.

No path of the archive is ever used as a path here: names are only read for whose file it is, and what is
written has names of our own. How much is unpacked is counted as it is unpacked, whatever the archive claims.
"""

import contextlib
import datetime
import re
import stat
import zipfile
from dataclasses import dataclass

import exercises
from exercises.grader.classroom.files import Trouble, append, digest, line, name_fault, write
from exercises.grader.classroom.submissions import LARGEST_NOTEBOOK

MOST_MEMBERS = 20_000
MOST_BYTES = (
    50_000_000,
    30,
)  # all notebooks together, unpacked: this, and so many times the archive's own size
MOST_PACKED = 200  # times smaller than what it holds, if that is large: text 10 times, a bomb 1000 times
LARGE = 5_000_000
LONGEST_PART, LONGEST_USER = 40, 20  # of a student's name, and of the number behind it that makes it unique
CANVAS = re.compile(
    r"(?P<name>[^_]+)_(?P<late>LATE_)?(?P<user>\d+)_(?P<upload>\d+)_(?P<file>.+)", re.IGNORECASE
)
MARK = "_assignsubmission_"
MOODLE = re.compile(rf"(?P<name>.+?)_(?P<user>\d+){MARK}(?:file|onlinetext)_?(?P<file>.*)")


@dataclass(frozen=True)
class Found:
    """A notebook in the archive, and whose it seems to be."""

    member: zipfile.ZipInfo
    user: str
    name: str
    file: str
    order: int  # the larger, the later it was handed in
    late: bool = False


def collect(path, folder, roster, unit=None):
    """Unpacks the notebooks; (number written, notes)."""
    unit = exercises.slug(unit) if unit else None
    try:
        with zipfile.ZipFile(path) as archive:
            return _collect(archive, path.stat().st_size, folder, roster, unit)
    except (zipfile.BadZipFile, OSError, NotImplementedError) as error:
        raise Trouble(f"{path} cannot be read as a ZIP archive: {line(error)}.") from None


def _collect(archive, size, folder, roster, unit):
    members = archive.infolist()
    if len(members) > MOST_MEMBERS:
        raise Trouble(f"The archive holds {len(members):,} files; at most {MOST_MEMBERS:,} are taken.")
    notes, latest, users = [], {}, {}
    for member in members:
        found = _found(member, notes)
        if found is None:
            continue
        student = student_of(found, roster, notes)
        of_unit = unit or unit_of(found.file)
        if student is None or of_unit is None:
            if of_unit is None:
                notes.append(f"{line(member.filename)!r}: which unit? Say --unit")
            continue
        users.setdefault(student, {})[found.user] = line(found.name)
        key, rank = (student, of_unit), (found.file == f"{of_unit}.ipynb", found.order)
        if key in latest:
            notes.append(f"{line(student)}/{of_unit}: several notebooks; the last one was taken")
        if key not in latest or rank > latest[key][0]:
            latest[key] = rank, found
    free, times = MOST_BYTES
    left, written = free + times * size, 0
    for (student, of_unit), (_, found) in sorted(latest.items()):
        if len(users[student]) > 1:  # names can be chosen, numbers cannot
            both = " and ".join(f"{name} ({number})" for number, name in users[student].items())
            notes.append(
                f"{line(student)} was left out: {both} would be the same; give their ids in roster.csv"
            )
            continue
        try:
            data = unpacked(archive, found.member, min(left, LARGEST_NOTEBOOK))
        except (
            Trouble,
            zipfile.BadZipFile,
            RuntimeError,
            NotImplementedError,
            OSError,
            EOFError,
            ValueError,
        ) as error:
            notes.append(f"{line(found.member.filename)!r} was left out: {line(error)}")
            continue
        left -= len(data)
        written += _keep(data, folder, student, of_unit, found)
    return written, notes


def _found(member, notes):
    """What a member's name tells, or None with a note. Folders and other files are passed over."""
    name = member.filename
    if (
        member.is_dir()
        or not name.lower().endswith(".ipynb")
        or "__MACOSX" in name
        or ".ipynb_checkpoints" in name
    ):
        return None
    mode = member.external_attr >> 16
    if stat.S_IFMT(mode) not in (0, stat.S_IFREG):
        notes.append(f"{line(name)!r} was left out: it is a link, or no plain file")
        return None
    parts = name.replace("\\", "/").split("/")
    if name.startswith(("/", "\\")) or ".." in parts or re.match(r"[A-Za-z]:", name) or "\0" in name:
        notes.append(f"{line(name)!r} was left out: its path leads out of the archive")
        return None
    if name.count(MARK) > 1:
        notes.append(f"{line(name)!r} was left out: it names two students")
        return None
    if len(parts) <= 2 and (match := CANVAS.fullmatch(parts[-1])):
        return Found(
            member,
            match["user"],
            match["name"],
            match["file"],
            int(match["upload"][:18]),
            bool(match["late"]),
        )
    for part in parts:
        if match := MOODLE.fullmatch(part):
            file = parts[-1] if part is not parts[-1] else match["file"]
            return Found(member, match["user"], match["name"], file, _when(member))
    notes.append(f"{line(name)!r} was left out: neither Canvas nor Moodle names files so")
    return None


def _when(member):
    return int("".join(f"{part:02}" for part in member.date_time))


def student_of(found, roster, notes):
    """The roster's id; without a roster, the name and number that the archive tells."""
    if roster is None:
        made = re.sub(r"[^\w.@+-]+", "_", found.name[:LONGEST_PART]).strip("._-")
        made = f"{made}_{found.user[:LONGEST_USER]}".strip("_")
        return made if not name_fault(made) else f"user_{found.user[:LONGEST_USER]}"
    student = roster.known_as(found.user, "canvas_id", "moodle_id", "lms_user_id")
    if student is None:
        named = {
            name
            for name, record in roster.students.items()
            if _letters(found.name)
            in (
                _letters(record.get("first_name", "") + record.get("last_name", "")),
                _letters(record.get("last_name", "") + record.get("first_name", "")),
                _letters(name),
            )
        }
        student = named.pop() if len(named) == 1 else None
    if student is None:
        notes.append(
            f"{line(found.member.filename)!r} was left out: nobody in roster.csv has the canvas_id or "
            f"moodle_id {found.user[:40]}, or that name"
        )
    return student


def _letters(text):
    return "".join(letter for letter in text.casefold() if letter.isalnum())


def unit_of(file):
    """The unit that a file's name begins with, or the only one whose slug is in it."""
    found = [unit for unit in exercises.units() if unit in file]
    number = re.match(r"0*(\d+)(?=[_\W])", file)
    if not found and number:
        found = [unit for unit in exercises.units() if int(unit.split("_")[0]) == int(number[1][:6])]
    return found[0] if len(found) == 1 else None


def unpacked(archive, member, most):
    """The member's bytes, at most `most` of them."""
    if member.flag_bits & 1:
        raise Trouble("it is encrypted")
    if member.file_size > most:
        raise Trouble(f"it has {member.file_size:,} bytes; at most {most:,} are taken")
    if member.file_size > LARGE and member.file_size > MOST_PACKED * max(member.compress_size, 1):
        raise Trouble("it is packed too tightly to be a notebook")
    with archive.open(member) as file:
        data = file.read(most + 1)
    if len(data) > most:
        raise Trouble(f"it has more than {most:,} bytes")
    return data


def _keep(data, folder, student, unit, found):
    """Writes one notebook; what stood there before is kept for the instructor. True if anything changed."""
    place = folder / "submitted" / student / unit
    for part in (folder / "submitted", place.parent, place):
        if part.is_symlink():
            raise Trouble(f"{part} is a link: nothing is written through it.")
    path = place / f"{unit}.ipynb"
    if path.is_file():
        before = path.read_bytes()
        if before == data:
            return False
        write(
            folder / "instructor" / "replaced" / student / unit / f"{digest(before)[:12]}.ipynb",
            before,
            private=True,
        )
    write(path, data)
    with contextlib.suppress(ValueError, OverflowError):  # a date that there is not
        if found.member.date_time[0] > 1980:
            when = datetime.datetime(*found.member.date_time).astimezone()
            write(place / "timestamp.txt", when.isoformat() + "\n")
    append(
        folder / "instructor" / "collected.jsonl",
        {
            "student": student,
            "unit": unit,
            "from": line(found.member.filename),
            "digest": digest(data),
            "late": found.late,
        },
    )
    return True
