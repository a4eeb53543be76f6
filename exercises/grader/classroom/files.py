"""Names, tables and files: written whole or not at all, and harmless to whoever opens them."""

import csv
import hashlib
import io
import json
import os
import re
import unicodedata
from pathlib import Path

LONGEST_NAME = 100
LARGEST_TABLE = 20_000_000  # bytes of a CSV file: a gradebook of 10,000 students has 5 million


class Trouble(Exception):
    """Something that the instructor can mend. Its text says how."""


def write(path, text, private=False):
    """Writes all of `text` or nothing of it, whatever happens meanwhile; what is there stays until then."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name[:80]}.{os.getpid()}.part")
    data = text if isinstance(text, bytes) else text.encode("utf-8", "replace")
    with open(
        os.open(part, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600 if private else 0o644), "wb"
    ) as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())
    os.replace(part, path)


def append(path, record):
    """One more line of JSON at the end of a journal."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "a", encoding="utf-8") as file:
        file.write(json.dumps(record) + "\n")
        file.flush()
        os.fsync(file.fileno())


def digest(data):
    return hashlib.sha256(data if isinstance(data, bytes) else data.encode("utf-8", "replace")).hexdigest()


# --- names and text -----------------------------------------------------------------------------------------


def name_fault(name):
    """Why `name` cannot be a student's folder, in words; "" if it can."""
    if not name or len(name.encode("utf-8", "surrogateescape")) > LONGEST_NAME:
        return f"a name has 1 to {LONGEST_NAME} bytes"
    if name.startswith((".", "-")) or name.endswith((".", " ")):
        return "a name starts with neither a dot nor a hyphen, and ends with neither a dot nor a space"
    if name != printable(name) or re.search(r"[\\/\n\t]", name):
        return "a name has no control characters and no slashes"
    return ""


def printable(text, longest=4000):
    """`text` without control characters: no terminal or page obeys what is left. Lines and tabs stay."""
    kept = "".join(
        letter
        if letter in "\n\t" or unicodedata.category(letter) not in ("Cc", "Cf", "Cs", "Co", "Zl", "Zp")
        else ("\n" if letter == "\r" else "�")
        for letter in _without_escapes(str(text)[: 4 * longest]).replace("\r\n", "\n")
    )
    return kept if len(kept) <= longest else kept[:longest] + " …"


def _without_escapes(text):
    """Without the sequences that colour or move on a terminal, which would leave litter behind."""
    text = re.sub(r"(?:\x1b\[|\x9b)[0-?]*[ -/]*[@-~]", "", text)
    return re.sub(r"(?:\x1b[\]PX^_]|[\x9d\x90])[^\x07\x1b\x9c]*(?:\x07|\x1b\\|\x9c)?", "", text)


def line(text, longest=200):
    """As `printable`, on one line."""
    return " ".join(printable(text, longest).split())


# --- tables -------------------------------------------------------------------------------------------------


def read_table(path, needed=()):
    """(header, rows as lists) of a CSV file, as spreadsheets write it: UTF-8, else Windows' Latin."""
    path = Path(path)
    try:
        data = path.read_bytes()
    except OSError as error:
        raise Trouble(f"{path} cannot be read: {error.strerror}.") from None
    if len(data) > LARGEST_TABLE:
        raise Trouble(f"{path.name} has {len(data):,} bytes; a table of up to {LARGEST_TABLE:,} is read.")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("cp1252", "replace")
    first = text.split("\n", 1)[0]
    delimiter = max(",;\t", key=first.count)
    try:
        rows = [row for row in csv.reader(io.StringIO(text, newline=""), delimiter=delimiter) if any(row)]
    except csv.Error as error:
        raise Trouble(f"{path.name} is not a CSV table: {error}.") from None
    if not rows:
        raise Trouble(f"{path.name} is empty; its first line names the columns.")
    missing = [name for name in needed if name not in [cell.strip().lower() for cell in rows[0]]]
    if missing:
        raise Trouble(f"{path.name} has no column {', '.join(missing)}; it has {', '.join(rows[0])}.")
    return rows[0], rows[1:]


def read_records(path, needed=()):
    """The rows as dictionaries, with the columns' names in small letters; comment lines begin with #."""
    header, rows = read_table(path, needed)
    names = [cell.strip().lower() for cell in header]
    return [
        dict(zip(names, [cell.strip() for cell in row] + [""] * len(names), strict=False))
        for row in rows
        if not row[0].startswith("#")
    ]


def table(header, rows):
    """CSV text. No cell is taken for a formula by the spreadsheet that opens it."""
    out = io.StringIO(newline="")
    csv.writer(out, lineterminator="\n").writerows(
        [[cell(value) for value in row] for row in [header, *rows]]
    )
    return out.getvalue()


def cell(value):
    """A cell's text. Text that a spreadsheet would compute gets an apostrophe before it."""
    if value is None:
        return ""
    if not isinstance(value, str):
        return str(value)
    text = printable(value, 2000)
    formula = re.match(r"\s*[=+\-@＝＋－＠\t\r]", text)
    number = re.fullmatch(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)?", text)
    return "'" + text if formula and not number else text
