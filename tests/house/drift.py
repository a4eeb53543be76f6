"""Drift: does a notebook's tagged cell still say what the package says?

A cell tagged `ref:integrators.rk4` must define `rk4` with the very syntax tree of `reference.integrators.rk4`
(docstrings, decorators and annotations aside), and each global name in it must mean the same there as in the
package: the package's own object, imported, or another tagged cell equal to the package's. From the tagged
cell on, that is: versions that a lesson grows through may stand above it.

Nothing is run: names are followed through the source, so a wrong import is found even where it would work.
"""

import ast
import builtins
import difflib
import re
import symtable
from pathlib import Path, PurePosixPath
from typing import NamedTuple

from . import tree
from .notebooks import cells, code

TAG = re.compile(r"ref:[A-Za-z_]\w*(\.[A-Za-z_]\w*)+")


# --- what a piece of source binds ---------------------------------------------------------------------------


class Binding(NamedTuple):
    """A name bound at the top of a module or cell: by an import (origin: of what) or here (None)."""

    name: str
    origin: str | None
    node: ast.AST


def bindings(body, package=""):
    """All bindings at the top level of a syntax tree, in order; `package`: where relative imports start."""
    found = []
    for node in _outside_functions(body):
        if isinstance(node, ast.Import):
            for name in node.names:
                root = name.name.split(".")[0]
                found.append(Binding(name.asname or root, name.name if name.asname else root, node))
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
            base = ".".join([*above, node.module] if node.module else above)
            found += [Binding(name.asname or name.name, f"{base}.{name.name}", node) for name in node.names]
        else:
            found += [Binding(name, None, node) for name in _names_bound(node)]
    return found


def _names_bound(node):
    if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
        # `global x` in a function may rebind x at the top
        return [
            node.name,
            *(n for inner in ast.walk(node) if isinstance(inner, ast.Global) for n in inner.names),
        ]
    if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
        return [node.id]
    for kind, field in ((ast.ExceptHandler, "name"), (ast.MatchAs, "name"), (ast.MatchStar, "name")):
        if isinstance(node, kind) and getattr(node, field):
            return [getattr(node, field)]
    return []


def _outside_functions(node):
    """The nodes below `node`, in order, but not the inside of functions, classes, comprehensions."""
    scopes = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda)
    scopes += (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)
    for child in ast.iter_child_nodes(node):
        yield child
        if not isinstance(child, scopes):
            yield from _outside_functions(child)
        else:  # a := b inside a comprehension binds outside it
            walrus = (inner.target for inner in ast.walk(child) if isinstance(inner, ast.NamedExpr))
            yield from walrus if isinstance(child, scopes[4:]) else ()


class Package:
    """The sources of `reference/`, and what each dotted name in them stands for in the end."""

    def __init__(self, root):
        self.files = {
            tree.module_name(file): file for file in tree.tracked(root, ".py") if file.parts[0] == "reference"
        }
        self.root, self._bound = root, {}

    def bound(self, module):
        if module not in self._bound:
            inside = module if self.files[module].name == "__init__.py" else module.rpartition(".")[0]
            self._bound[module] = bindings(tree.parse(self.root, self.files[module]), inside)
        return self._bound[module]

    def split(self, dotted):
        """reference.a.b.f -> (reference.a.b, [f]): the longest part that is a module, and the rest."""
        parts = dotted.split(".")
        for cut in range(len(parts), 0, -1):
            if ".".join(parts[:cut]) in self.files:
                return ".".join(parts[:cut]), parts[cut:]
        return None, parts

    def resolve(self, dotted, seen=()):
        """Follow imports to where a name is defined; outside the package it stands for itself; or None."""
        module, rest = self.split(dotted)
        if module is None or not rest:
            return dotted
        if dotted in seen:
            return None
        for binding in reversed(self.bound(module)):
            if binding.name in (rest[0], "*"):
                if binding.name == "*":
                    origin = self.resolve(f"{binding.origin.removesuffix('.*')}.{rest[0]}", (*seen, dotted))
                else:
                    origin = f"{module}.{rest[0]}"
                    if binding.origin:
                        origin = self.resolve(binding.origin, (*seen, dotted))
                if origin:
                    return ".".join([origin, *rest[1:]])
        return None

    def definition(self, dotted):
        """The syntax of what a dotted name stands for: a top-level function, class, assignment, or None."""
        module, rest = self.split(dotted)
        return (
            definition(tree.parse(self.root, self.files[module]), rest[0])
            if module and len(rest) == 1
            else None
        )


def definition(body, name):
    """The last top-level statement of a syntax tree that defines `name`."""
    for node in reversed(body.body):
        targets = getattr(node, "targets", [getattr(node, "target", None)])
        names = [target.id for target in targets if isinstance(target, ast.Name)]
        if getattr(node, "name", None) == name or name in names:
            return node
    return None


# --- what makes two definitions the same --------------------------------------------------------------------


class _Bare(ast.NodeTransformer):
    """Take off docstrings, decorators and annotations."""

    def _bare_body(self, node):
        self.generic_visit(node)
        node.decorator_list, node.type_params = [], []
        if ast.get_docstring(node, clean=False) is not None:
            node.body = node.body[1:] or [ast.Pass()]
        return node

    def visit_ClassDef(self, node):
        return self._bare_body(node)

    def visit_FunctionDef(self, node):
        node.returns = None
        return self._bare_body(node)

    visit_AsyncFunctionDef = visit_FunctionDef

    def visit_arg(self, node):
        return ast.arg(node.arg)

    def visit_AnnAssign(self, node):
        self.generic_visit(node)
        return ast.Assign([node.target], node.value or ast.Constant(None))

    def visit_Constant(self, node):
        return ast.Constant(node.value)


def bare(node):
    """A copy of a definition with nothing in it but what it does."""
    copy = ast.parse(ast.unparse(node)).body[0]
    return ast.fix_missing_locations(_Bare().visit(copy))


def globals_of(node):
    """The global names that a (bare) definition uses, in its body, its defaults and its bases."""
    used = set()
    pending = [symtable.symtable(ast.unparse(node), "cell", "exec")]
    while pending:
        table = pending.pop()
        pending += table.get_children()
        top = table.get_type() == "module"
        used |= {s.get_name() for s in table.get_symbols() if (s.is_referenced() if top else s.is_global())}
    return used


# --- the notebook -------------------------------------------------------------------------------------------


class Bound(NamedTuple):
    """A name bound in a notebook: in which cell, and what it stands for (None: the cell's own)."""

    name: str
    cell: int
    origin: str | None
    node: ast.AST


def notebook_bindings(found, package):
    """Everything that a notebook's cells bind, in order; a tagged definition stands for the package's."""
    all_bound = []
    for cell in found:
        if cell.kind != "code":
            continue
        claimed = {
            tag.rpartition(".")[2]: package.resolve("reference." + tag[4:])
            for tag in cell.tags
            if TAG.fullmatch(tag)
        }
        for name, origin, node in bindings(code(cell)):
            origin = package.resolve(origin) if origin else claimed.get(name)
            all_bound.append(Bound(name, cell.number, origin, node))
    return all_bound


def drift_faults(root, file):
    """All the ways in which a notebook's tagged cells differ from the package."""
    package, found = Package(root), cells(Path(root) / file)
    bound = notebook_bindings(found, package)
    faults = []
    for cell in found:
        for tag in cell.tags:
            if tag.startswith("ref:"):
                faults += [
                    f"{file}: {cell.name}, {tag}: {fault}" for fault in _tag_faults(cell, tag, bound, package)
                ]
            elif re.match(r"\s*ref", tag, re.IGNORECASE):
                faults.append(f"{file}: {cell.name}: the tag {tag!r} must read ref:module.function")
        if any(TAG.fullmatch(tag) for tag in cell.tags) and cell.kind == "code":
            faults += [f"{file}: {cell.name} {fault}" for fault in _stowaways(cell)]
    faults += [f"{file}: {fault}" for fault in _patches(found, bound)]
    return faults


def _tag_faults(cell, tag, bound, package):
    if not TAG.fullmatch(tag):
        return ["the tag must read ref:module.function"]
    wanted = package.resolve("reference." + tag[4:])
    theirs = package.definition(wanted) if wanted else None
    if theirs is None:
        return [f"names nothing that reference/ defines ({tag[4:]})"]
    name = tag.rpartition(".")[2]
    ours = definition(code(cell), name) if cell.kind == "code" else None
    if ours is None:
        return [f"the cell does not define {name}"]
    theirs, ours = bare(theirs), bare(ours)
    if ast.dump(theirs) != ast.dump(ours):
        return [f"differs from {wanted}:\n{_difference(theirs, ours)}"]
    module = wanted.rpartition(".")[0]
    return [
        fault
        for used in sorted(globals_of(theirs) | {name})
        for fault in _name_faults(used, package.resolve(f"{module}.{used}"), cell.number, bound, package)
    ]


def _name_faults(name, wanted, cell, bound, package):
    """From its tagged cell on, must `name` mean `wanted` (None: Python's own)?"""
    those = [b for b in bound if b.name == name]
    above, below = [b for b in those if b.cell <= cell], [b for b in those if b.cell > cell]
    shown = wanted or f"Python's own {name}"
    if not those and (wanted is not None or not hasattr(builtins, name)):
        return [f"uses {name}, which the notebook never binds; the package means {shown}"]
    if any(b.name == "*" for b in bound):
        return ["a star import hides what names mean"]
    wrong = [b.cell for b in above[-1:] + below if b.origin != wanted or wanted is None]
    return [f"uses {name}, which in cell {number} is not {shown}" for number in wrong]


def _difference(theirs, ours):
    lines = difflib.unified_diff(
        ast.unparse(theirs).split("\n"), ast.unparse(ours).split("\n"), "package", "notebook", "", "", 0
    )
    return "\n".join(line.rstrip() for line in lines if not line.startswith("@@"))


def _stowaways(cell):
    """A tagged cell holds what its tags name and nothing else, so what a student reads is the package."""
    named = {tag.rpartition(".")[2] for tag in cell.tags if TAG.fullmatch(tag)}
    for node in code(cell).body:
        names = {binding.name for binding in bindings(ast.Module([node], []))}
        if not names & named:
            yield f"holds more than its tags name: {ast.unparse(node).splitlines()[0][:60]!r}"


def _patches(found, bound):
    """Assigning to an attribute of the package's objects would change them behind the tagged cells' back."""
    theirs = {b.name for b in bound if (b.origin or "").startswith("reference")}
    for cell in found:
        for node in ast.walk(code(cell)) if cell.kind == "code" else ():
            if isinstance(node, ast.Attribute) and not isinstance(node.ctx, ast.Load):
                root = node.value
                while isinstance(root, ast.Attribute):
                    root = root.value
                if isinstance(root, ast.Name) and root.id in theirs:
                    yield f"{cell.name} changes the package: {ast.unparse(node)}"


# --- what a lesson must tag ---------------------------------------------------------------------------------


def tag_faults(root, file):
    """A lesson arrives at the reference: it has tagged cells, they are of the page's modules, and a function
    of those modules that the lesson grows ends in a tagged cell."""
    package, found = Package(root), cells(Path(root) / file)
    page = PurePosixPath("lectures", f"{file.stem}.md")
    listed = {tree.module_name(module) for module in tree.page_modules(root, page)}
    modules = {m for m in package.files if any((m + ".").startswith(name + ".") for name in listed)}
    tags = [tag for cell in found for tag in cell.tags if TAG.fullmatch(tag)]
    faults = [] if tags else [f"{file}: no cell is tagged ref:module.function"]
    for tag in tags:
        wanted = package.resolve("reference." + tag[4:])
        if wanted and wanted.rpartition(".")[0] not in modules:
            faults.append(f"{file}: {tag} is of a module that the page does not list")
    last = {bound.name: bound for bound in notebook_bindings(found, package)}
    public = {b.name: m for m in modules for b in package.bound(m) if isinstance(b.node, ast.FunctionDef)}
    for name, bound in sorted(last.items()):
        if (
            bound.origin is None
            and isinstance(bound.node, ast.FunctionDef)
            and name in public
            and name[0] != "_"
        ):
            faults.append(
                f"{file}: cell {bound.cell}: the last version of {name} is not tagged ({public[name]}.{name})"
            )
    return faults
