"""Links: relative links lead somewhere; slide, page, notebook, module and exercise name one another."""

import ast
import posixpath
import re
from pathlib import Path, PurePosixPath
from typing import NamedTuple
from urllib.parse import unquote, urlsplit

from . import tree
from .notebooks import cells

# [text](target "title"), with one level of brackets inside the text and of parentheses inside the target
INLINE = re.compile(
    r"(!?)\[((?:[^\[\]]|!?\[[^\[\]]*\](?:\([^()]*\))?)*)\]"
    r"\(\s*<?((?:[^()\s<>]|\([^()\s]*\))*)>?(?:\s+\"[^\"]*\")?\s*\)"
)
DEFINED = re.compile(r"^ {0,3}\[([^\]^]+)\]:\s+<?([^\s>]+)>?", re.MULTILINE)
AUTO = re.compile(r"<((?:https?|ftp|file|mailto):[^\s>]*)>")
TAG = re.compile(r"<(?:a|img)\b[^>]*?\b(?:href|src)\s*=\s*[\"']([^\"']*)[\"'][^>]*>", re.IGNORECASE)
ROLE = re.compile(r"\{(doc|ref|numref|eq|download)\}`(?:[^`<]*<)?([^`<>]+)>?`")
PATHS = {"figure", "image", "include", "literalinclude", "download"}  # directives whose argument is a file
VERBATIM = {"", "math", "code", "code-block", "code-cell", "mermaid"}  # blocks whose inside is not Markdown


class Link(NamedTuple):
    target: str
    alt: str | None = None  # the words for a picture; None where it is not a picture


def prose(words):
    """Markdown without what only looks like it: verbatim blocks and formulas. Directives' text stays."""
    kept, fence, verbatim = [], [], []
    for line in words.splitlines():
        mark = re.match(r"\s*(`{3,}|~{3,}|:{3,})\s*(?:\{([\w:-]+)\}|(\w[\w+-]*))?", line)
        if mark and fence and line.strip() == mark.group(1) and mark.group(1).startswith(fence[-1]):
            fence.pop(), verbatim.pop()
        elif mark and not (verbatim and verbatim[-1]):
            fence.append(mark.group(1))
            verbatim.append(not mark.group(1).startswith(":") and (mark.group(2) or "") in VERBATIM)
            kept.append(line if mark.group(2) else "")
        else:
            kept.append("" if verbatim and verbatim[-1] else line)
    text = re.sub(r"\$\$.*?\$\$", "", "\n".join(kept), flags=re.DOTALL)
    return re.sub(r"(?<!\\)\$[^$\n]+\$", "", text)


def links(words):
    """All links and pictures in a Markdown text."""
    text = prose(words)
    found = [_role(kind, target.strip()) for kind, target in ROLE.findall(text)]
    found += _directives(text)
    text = re.sub(r"(`+)(?!`).*?(?<!`)\1(?!`)", "", text)
    for picture, label, target in INLINE.findall(text):
        found.append(Link(target, label if picture else None))
        found += [Link(t, alt if p else None) for p, alt, t in INLINE.findall(label)]
    found += [Link(target) for _, target in DEFINED.findall(text)]
    found += [Link(target) for target in AUTO.findall(text)]
    for tag in TAG.finditer(text):
        alt = re.search(r"\balt\s*=\s*[\"']([^\"']*)[\"']", tag.group())
        found.append(
            Link(
                tag.group(1),
                (alt.group(1) if alt else "") if tag.group().lower().startswith("<img") else None,
            )
        )
    return found


def _role(kind, target):
    """What {doc}`page`, {download}`file` and {ref}`label` point at."""
    if kind == "doc":
        return Link(target if target.endswith((".md", ".ipynb")) else target + ".md")
    return Link(target if kind == "download" else "#" + target)


def _directives(text):
    """```{figure} path with its `:alt:` line."""
    for found in re.finditer(
        r"(?m)^\s*(?:`{3,}|:{3,})\{([\w-]+)\}[ \t]+(\S+)[^\n]*\n((?:\s*:[\w-]+:[^\n]*\n)*)", text
    ):
        kind, target, options = found.groups()
        if kind in PATHS:
            alt = re.search(r":alt:[ \t]*([^\n]*)", options)
            yield Link(target, (alt.group(1) if alt else "") if kind in ("figure", "image") else None)


def anchors(root, file):
    """What `file#…` may point at: slugs of headings, and MyST labels."""
    if file.suffix == ".ipynb":
        words = "\n\n".join(cell.source for cell in cells(Path(root) / file) if cell.kind == "markdown")
    else:
        words = tree.text(root, file) or ""
    if file.suffix not in (".md", ".ipynb"):
        return set()
    found, text = set(), prose(words)
    for heading in re.findall(r"(?m)^ {0,3}#{1,6}[ \t]+(.+?)[ \t]*#*$", text):
        heading = re.sub(r"\{[^}]*\}`([^`]*)`", r"\1", heading)
        slug = re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")
        copies = sum(1 for other in found if re.fullmatch(re.escape(slug) + r"(-\d+)?", other))
        found |= {f"{slug}-{copies}" if slug in found else slug, heading.replace(" ", "-")}
    found |= set(re.findall(r"(?m)^\(([^()\s]+)\)=\s*$", text))
    found |= set(re.findall(r":(?:name|label):\s*(\S+)", words)) | set(re.findall(r"\{#([\w:-]+)\}", text))
    return found | set(re.findall(r"<a\s+(?:id|name)=[\"']([^\"']+)", words))


def sources(root):
    """The texts whose links must hold: file -> its Markdown."""
    texts = {}
    for file in tree.tracked(root, ".md", ".ipynb"):
        if file.suffix == ".md":
            texts[file] = tree.text(root, file) or ""
        else:
            texts[file] = "\n\n".join(
                cell.source for cell in cells(Path(root) / file) if cell.kind == "markdown"
            )
    return texts


def link_faults(root):
    """Links that lead nowhere, and pictures without words."""
    files = set(tree.tracked(root))
    folders = {parent for file in files for parent in file.parents}
    known = {}
    faults = []
    for file, words in sources(root).items():
        for link in links(words):
            fault = _target_fault(root, file, link.target, files, folders, known)
            if fault is None and file.suffix == ".ipynb":
                fault = _copy_fault(file, link.target)
            if fault:
                faults.append(f"{file}: the link to {link.target!r} {fault}")
            if link.alt is not None and len(link.alt.strip()) < 5:
                faults.append(f"{file}: the picture {link.target!r} has no words for those who can't see it")
    return faults


def _target_fault(root, file, target, files, folders, known):
    parts = urlsplit(target)
    if parts.scheme:
        fine = parts.scheme == "https" and re.fullmatch(r"[\w-]+(\.[\w-]+)+", parts.netloc)
        return None if fine or parts.scheme == "mailto" else "is not a relative path and not https"
    if target.startswith("/"):
        return "starts at the root of a machine: make it relative"
    path = (
        PurePosixPath(posixpath.normpath(posixpath.join(file.parent.as_posix(), unquote(parts.path))))
        if parts.path
        else file
    )
    if ".." in path.parts:
        return "leaves the repository"
    if path not in files and path not in folders:
        return "leads nowhere (not a tracked file)"
    if parts.fragment:
        if path not in known:
            known[path] = anchors(root, path) if path in files else set()
        if unquote(parts.fragment) not in known[path]:
            return f"names a place that {path} does not have"
    return None


def _copy_fault(file, target):
    """Students read a notebook as a copy in work/, beside other copies, lectures/ and reference/."""
    parts = urlsplit(target)
    path = PurePosixPath(posixpath.normpath(posixpath.join(file.parent.as_posix(), parts.path)))
    if parts.scheme or not parts.path or path.parts[0] in ("lectures", "reference"):
        return None
    return (
        None
        if path in (tree.notebook_of(path.stem), tree.exercise_of(path.stem))
        else "is not there in work/"
    )


def linked_from(file, words):
    """The files that a text links to, as paths from the root."""
    targets = (urlsplit(link.target) for link in links(words))
    return {
        PurePosixPath(
            posixpath.normpath(posixpath.join(PurePosixPath(file).parent.as_posix(), unquote(t.path)))
        )
        for t in targets
        if t.path and not t.scheme
    }


# --- slide, page, notebook, module, exercise ----------------------------------------------------------------


def page_faults(root, slug):
    """A page's front matter is true, and it links to its notebook, modules and exercise."""
    page = PurePosixPath("lectures", f"{slug}.md")
    head = tree.front_matter(root, page)
    missing = [key for key in ("title", "unit", "slides", "modules", "minutes") if not head.get(key)]
    if missing:
        return [f"{page}: the front matter lacks {', '.join(missing)} (or can't be read)"]
    faults = []
    if head["unit"] != slug:
        faults.append(f"{page}: the front matter says unit {head['unit']}, must be {slug}")
    if not isinstance(head["minutes"], int) or not 10 <= head["minutes"] <= 600:
        faults.append(f"{page}: minutes must be a whole number of minutes, not {head['minutes']!r}")
    slides = {str(name) for name in head["slides"]}
    faults += [f"{page}: there is no slide {name}" for name in sorted(slides - tree.SLIDES)]
    faults += [f"{page}: the unit must serve slide {name}" for name in sorted(tree.UNITS[slug] - slides)]
    faults += [
        f"{page}: text does not name slide {name}" for name in sorted(slides - _slides_of_text(root, page))
    ]
    linked = linked_from(page, tree.text(root, page))
    for name in head["modules"]:
        file = tree.module_file(root, name)
        if file is None:
            faults.append(f"{page}: the module {name} is not in reference/")
        elif not linked & {file, file.parent if file.name == "__init__.py" else file}:
            faults.append(f"{page}: no link to its module {file}")
    for other in (tree.notebook_of(slug), tree.exercise_of(slug)):
        if not (Path(root) / other).is_file():
            faults.append(f"{page}: {other} does not exist")
        elif other not in linked:
            faults.append(f"{page}: no link to {other}")
    return faults


def _slides_of_text(root, page):
    return tree.slides_in(tree.text(root, page).split("\n---\n", 1)[-1])


def back_faults(root):
    """Notebooks, exercises and modules name the pages that name them."""
    faults = []
    written = tree.pages(root)
    for file in tree.tracked(root, ".ipynb"):
        depth = {"notebooks": 2, "exercises": 3}.get(file.parts[0], 0)
        if len(file.parts) > depth:
            continue  # solutions and mistakes of an exercise are not a student's
        if file.stem not in written or file not in (tree.notebook_of(file.stem), tree.exercise_of(file.stem)):
            faults.append(f"{file}: no unit's page belongs to it")
            continue
        first = cells(Path(root) / file)[0]
        if written[file.stem] not in linked_from(file, first.source):
            faults.append(f"{file}: the first cell does not link to {written[file.stem]}")
        if not tree.slides_in(first.source) & tree.UNITS[file.stem]:
            faults.append(f"{file}: the first cell names none of the unit's slides")
    return faults + module_faults(root)


def module_faults(root):
    """Each module is in some page's list, and its docstring names such a page and slides of it.

    A page that lists a whole package lists all modules in it, but these need not name that page.
    """
    faults = []
    listing = {page: set(tree.page_modules(root, page)) for page in tree.pages(root).values()}
    for file in tree.tracked(root, ".py"):
        if file.parts[0] != "reference" or file == PurePosixPath("reference/__init__.py"):
            continue
        body, doors = tree.parse(root, file), {folder / "__init__.py" for folder in file.parents}
        own = {page for page, files in listing.items() if file in files}
        covering = {page for page, files in listing.items() if files & {file, *doors}}
        defines = any(isinstance(node, (ast.FunctionDef, ast.ClassDef)) for node in body.body)
        if file.name == "__init__.py" and not covering and not defines:
            continue  # a package's front door, which only passes on what its modules define
        words = ast.get_docstring(body) or ""
        named = {PurePosixPath(name) for name in re.findall(r"lectures/\w+\.md", words)}
        slides = tree.slides_in(words)
        faults += [] if covering else [f"{file}: no page lists this module"]
        faults += [] if named else [f"{file}: the docstring names no page"]
        faults += [f"{file}: the docstring does not name {page}" for page in sorted(own - named)]
        faults += [f"{file}: names {page}, which does not list it" for page in sorted(named - covering)]
        faults += [f"{file}: there is no slide {name}" for name in sorted(slides - tree.SLIDES)]
        for page in sorted(covering & named):
            if not slides & {str(name) for name in tree.front_matter(root, page).get("slides", ())}:
                faults.append(f"{file}: the docstring names none of the slides of {page}")
    return faults


def index_faults(root):
    """The index names all units in order; the written ones are linked, the others marked."""
    index = PurePosixPath("lectures/index.md")
    words = tree.text(root, index) if (Path(root) / index).is_file() else ""
    faults, place = [], -1
    for slug in tree.UNITS:
        number, exists = slug[:2], (Path(root) / f"lectures/{slug}.md").is_file()
        rows = [
            line
            for line in words.splitlines()
            if re.match(rf"[|\-*\s]*\[?`?{number}\b", line) or slug in line
        ]
        if not rows:
            faults.append(f"{index}: unit {slug} has no row that starts with {number}")
            continue
        row = rows[0]
        if words.index(row) < place:
            faults.append(f"{index}: unit {slug} is out of order")
        place = words.index(row)
        marked = re.search(r"not (yet )?written|to be written|to come|planned", row, re.IGNORECASE)
        linked = PurePosixPath("lectures", f"{slug}.md") in linked_from(index, row)
        if exists and (not linked or marked):
            faults.append(f"{index}: unit {slug} is written: link it and do not mark it otherwise")
        if not exists and (linked or not marked):
            faults.append(
                f"{index}: unit {slug} is not written: say so ('not yet written') and do not link it"
            )
    return faults
