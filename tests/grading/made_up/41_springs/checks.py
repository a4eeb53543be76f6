"""Checks of a made-up exercise: other kinds of arguments, answers and judges than unit 02 has."""

import numpy as np
import scipy.sparse

from exercises.grader.check import Call, Case, Check, cause_like
from exercises.grader.judges import equal, unordered, word
from exercises.grader.replies import Given, Reply, Student


def chain(v):
    """Stiffness matrix of a chain of equal springs, fixed at both ends."""
    n = v["bodies"]
    return v["stiffness"] * scipy.sparse.diags_array([-1.0, 2.0, -1.0], offsets=[-1, 0, 1], shape=(n, n))


def check(name, judge, visible, hidden, **more):
    words = {"title": f"the {name}", "why": "Only rounding.", "form": "see the title", "section": "Springs"}
    made = [Case("as on the page", values) for values in visible]
    return Check(
        name, points=5, judge=judge, visible=tuple(made), hidden=hidden, hint="Look again.", **words, **more
    )


def draw(make):
    return lambda stream: [Case("drawn", make(stream)) for _ in range(3)]


CHECKS = (
    check(
        "stiffness",
        equal(chain, 1e-12),
        [{"bodies": 3, "stiffness": 2.0}],
        draw(lambda stream: {"bodies": int(stream.integers(2, 9)), "stiffness": float(stream.uniform(1, 3))}),
        causes=(cause_like("The sign is wrong.", lambda v: -chain(v).toarray()),),
    ),
    check(
        "force",
        equal(lambda v: -v["force"].parameters["stiffness"] * v["stretch"], 1e-12),
        [{"force": Given("spring", stiffness=2.0), "stretch": 0.5}],
        draw(lambda s: {"force": Given("spring", stiffness=s.uniform(1, 2)), "stretch": s.uniform(1, 2)}),
    ),
    check(
        "modes",
        unordered(lambda v: np.linalg.eigvalsh(v["matrix"])[:, None], 1e-9),
        [{"matrix": np.diag([3.0, 1.0, 2.0])}],
        draw(lambda stream: {"matrix": np.diag(stream.uniform(1, 2, 4))}),
    ),
    check(
        "verdict",
        word(lambda v: "stable" if v["stiffness"] > 0 else "unstable"),
        [{"stiffness": 1.0}, {"stiffness": -1.0}],
        draw(lambda stream: {"stiffness": float(stream.uniform(-1, 1))}),
        reply=Reply(words=("stable", "unstable")),
        calls=lambda v: [Call("verdict", (v["stiffness"], Student("force")))],
    ),
)
