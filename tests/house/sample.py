"""A small tree that keeps every rule of the house, in which a test plants one fault.

`plant(folder)` writes one whole unit: a page, a notebook, two modules, an exercise, an index, a README.
"""

import json
from pathlib import Path

from .tree import UNITS

SLUG = "02_equation_of_motion"
PAGE, LESSON = f"lectures/{SLUG}.md", f"notebooks/{SLUG}.ipynb"
EXERCISE = f"exercises/{SLUG}/{SLUG}.ipynb"
BODIES, INTEGRATORS = "reference/bodies.py", "reference/integrators.py"

FILES = {
    "README.md": "# Courseware\n\n`python3 course.py lab --port 8888`\n\n[Lectures](lectures/index.md).\n",
    PAGE: f"""---
title: The equation of motion
unit: {SLUG}
slides: [S4, S9]
modules: [bodies, integrators]
minutes: 90
---
# The equation of motion

Slides S4 and S9. Run the [notebook](../notebooks/{SLUG}.ipynb), then do
the [exercise](../exercises/{SLUG}/{SLUG}.ipynb).
The functions are in [bodies](../reference/bodies.py) and [integrators](../reference/integrators.py);
see [below](#one-step).

(eq-step)=
## One step

Velocity first: see {{ref}}`eq-step`. ![A ball falls along a parabola](ball.svg)

```python
rows = [1](no_link)  # not a link: code
```
""",
    "lectures/ball.svg": "<svg/>\n",
    BODIES: f'''"""Bodies as arrays. Slide S4; lectures/{SLUG}.md."""

import numpy as np

GRAVITY = 9.81


def accelerate(force, mass):
    """Acceleration of a body."""
    return np.asarray(force) / mass


def fall(velocity, dt):
    """The velocity a step later."""
    return velocity - GRAVITY * dt
''',
    INTEGRATORS: f'''"""Integrators. Slide S9; the page is lectures/{SLUG}.md."""

from .bodies import accelerate


def step(position, velocity, force, mass, dt=0.1):
    """One step, velocity first."""
    velocity = velocity + dt * accelerate(force, mass)
    return position + dt * velocity, velocity


def energy(velocity, mass, *, half=0.5):
    return half * mass * sum(velocity * velocity)
'''.replace("half=0.5):", 'half=0.5):\n    """Of motion."""'),
    "reference/__init__.py": '"""The reference."""\n\nfrom .integrators import step as step\n',
    "course.py": """import argparse

parser = argparse.ArgumentParser()
commands = parser.add_subparsers(required=True)
commands.add_parser("lab").add_argument("--port")
commands.add_parser("test")
parser.parse_args()
""",
}

BODIES_CELL = "def accelerate(force, mass):\n    return np.asarray(force) / mass"
STEP_CELL = (
    "@compiled\ndef step(position: float, velocity, force, mass, dt=0.1) -> tuple:\n"
    "    '''In the notebook.'''\n"
    "    velocity = velocity + dt * accelerate(force, mass)\n    return position + dt * velocity, velocity"
)


def text(words):
    return {"cell_type": "markdown", "metadata": {}, "source": words}


def code(words, *tags):
    metadata = {"tags": list(tags)} if tags else {}
    return {
        "cell_type": "code",
        "metadata": metadata,
        "source": words,
        "outputs": [],
        "execution_count": None,
    }


def lesson():
    """The cells of a lesson that keeps the rules."""
    cells = [
        text(f"# 02 The equation of motion\n\nObjectives. Slides S4, S9; [page](../{PAGE})."),
        code("import numpy as np"),
    ]
    cells += [
        text("## 1 Force"),
        code(BODIES_CELL, "ref:bodies.accelerate"),
        code("assert accelerate(1.0, 2.0) == 0.5"),
    ]
    cells += [
        text("## 2 A step"),
        code("def step(position, velocity):\n    return position + velocity, velocity"),
    ]
    cells += [code("assert step(0, 1) == (1, 1)"), code("compiled = lambda function: function")]
    cells += [code(STEP_CELL, "ref:integrators.step"), code("assert step(0, 1, 0, 1, 1)[0] == 1")]
    for number in (3, 4, 5):
        cells += [
            text(f"## {number} More"),
            text("Predict."),
            code(f"x = {number}"),
            code(f"assert x == {number}"),
        ]
    cells += [text("## Against the engine"), code("np.testing.assert_allclose(1.0, 1.0)")]
    return [*cells, text("## Recap"), text("## On your own"), code("x = 0")]


def exercise():
    return [
        text(f"# Exercise\n\nSlides S4, S9; [page](../../{PAGE})."),
        code("answer = 1"),
        text("Now check."),
        code("answer"),
    ]


def write_notebook(path, cells, **changes):
    """Write cells as a notebook, with readable ids."""
    cells = [{"id": f"cell-{number:02}", **cell} for number, cell in enumerate(cells, 1)]
    kernel = {
        "kernelspec": {"name": "python3", "display_name": "Python 3"},
        "language_info": {"name": "python"},
    }
    book = {"nbformat": 4, "nbformat_minor": 5, "metadata": kernel, "cells": cells, **changes}
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(book, indent=1), encoding="utf-8")


def index():
    rows = ["# Units", "", "| unit | slides |", "|---|---|"]
    for slug, slides in UNITS.items():
        row = (
            f"[{slug[:2]} {slug[3:]}]({slug}.md)"
            if slug == SLUG
            else f"{slug[:2]} {slug[3:]} (not yet written)"
        )
        rows.append(f"| {row} | {', '.join(sorted(slides))} |")
    return "\n".join(rows) + "\n"


def plant(folder):
    """Write the tree; returns its root."""
    root = Path(folder) / "tree"
    for name, words in {**FILES, "lectures/index.md": index()}.items():
        file = root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(words, encoding="utf-8")
    write_notebook(root / LESSON, lesson())
    write_notebook(root / EXERCISE, exercise())
    return root


def edit(root, name, old, new):
    """Replace text in a file of the tree; the text must be there, or the fault would not be planted."""
    words = (root / name).read_text(encoding="utf-8")
    assert old in words, f"{old!r} is not in {name}"
    (root / name).write_text(words.replace(old, new), encoding="utf-8")
