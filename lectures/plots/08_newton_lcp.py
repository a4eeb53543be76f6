"""Figures and tables of unit 08, Newton and beyond: lectures/08_newton_lcp.md."""

import matplotlib.pyplot as plt
import numpy as np

from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.lcp import (
    ConeProblem,
    apgd,
    cone_newton,
    fischer_newton,
    gauss_seidel,
    interior_point,
    min_map_newton,
    nncg,
)
from reference.lcp.fischer import fischer_burmeister


def functions():
    """The zero lines are the corner; the rest of the two functions, as contours."""
    figure, panels = plt.subplots(1, 2, figsize=(7.5, 3.5), sharey=True)
    a, b = np.meshgrid(np.linspace(-1, 2, 301), np.linspace(-1, 2, 301))
    for axes, name, value in (
        (panels[0], "min(a, b)", np.minimum(a, b)),
        (panels[1], "Fischer–Burmeister φ(a, b)", fischer_burmeister(a, b)[0]),
    ):
        axes.contour(a, b, value, levels=np.arange(-3, 2, 0.25), colors="0.7", linestyles="-", linewidths=0.8)
        axes.contour(a, b, value, levels=[0], colors="C0", linestyles="-", linewidths=2.5)
        axes.plot([0, 2], [0, 2], color="C1", linestyle=":", label="a = b")
        axes.set(title=name, xlabel="a = λ (N s)", aspect="equal")
    panels[0].set(ylabel="b = w/d (N s)")
    panels[1].legend(loc="lower right", fontsize=8)
    return figure


def histories():
    """Residual against iterations on a column of 20 equal boxes, and of 20 with the top × 100."""
    figure, panels = plt.subplots(1, 2, figsize=(8.5, 3.4), sharey=True)
    methods = gauss_seidel, nncg, apgd, min_map_newton, fischer_newton, interior_point
    for axes, heavy in zip(panels, (1, 100), strict=True):
        problem = LCP_PROBLEMS["column"](20, heavy).problem
        for method in methods:
            history = method(problem, tolerance=1e-12, max_iterations=3000).history
            axes.loglog(np.arange(len(history)) + 1, np.maximum(history, 1e-16), label=method.__name__)
        axes.set(xlabel="iterations + 1", title=f"20 boxes, top × {heavy}")
    panels[0].set(ylabel="residual", ylim=(1e-14, 3))
    panels[1].legend(loc="upper left", bbox_to_anchor=(1, 1), fontsize=8)
    return figure


def kostreva_path(line_search):
    """min_map_newton's λ on Kostreva's example from (1, 0, 0), step by step."""
    problem = LCP_PROBLEMS["kostreva"]().problem
    return np.array(
        [min_map_newton(problem, (1, 0, 0), max_iterations=k, line_search=line_search).lam for k in range(8)]
    )


def kostreva():
    """Newton's method going round, and getting out."""
    figure, axes = plt.subplots(figsize=(7.5, 2.8))
    for line_search, label in ((False, "full steps only"), (True, "with the line search")):
        away = np.abs(kostreva_path(line_search) - 1 / 3).max(axis=1)
        axes.plot(away, marker="o", label=label)
    axes.set(xlabel="iteration", ylabel="error of λ")
    axes.legend()
    return figure


def slide(law, v=2.0, h=0.02, μ=0.5, steps=50):
    """A point of 1 kg sliding on the ground: times, heights and speeds, one contact solved a step."""
    state, rows = np.array([0.0, v]), []
    height = 0.0
    for k in range(steps + 1):
        rows.append((k * h, height, state[1]))
        b = np.array([state[0] - 9.81 * h + height / h, state[1]])  # w_n ≥ −height/h
        λ = cone_newton(ConeProblem(np.eye(2), b, μ, law=law, dimension=2)).lam
        state = state + [-9.81 * h, 0] + λ
        height += h * state[0]
    return np.array(rows).T


def lift_off():
    """The artefact of the convex law: what slides, hovers."""
    figure, panels = plt.subplots(1, 2, figsize=(8.5, 3))
    for law, label in (("ncp", "Coulomb (ncp)"), ("ccp", "convex (ccp)")):
        time, height, speed = slide(law)
        panels[0].plot(time, 1000 * height, label=label)
        panels[1].plot(time, speed, label=label)
    panels[0].set(xlabel="time (s)", ylabel="height (mm)")
    panels[1].set(xlabel="time (s)", ylabel="speed along the ground (m/s)")
    panels[0].legend()
    return figure


def directions():
    """The greatest friction in each direction: cone, inscribed pyramid, box, over μ N."""
    figure, axes = plt.subplots(figsize=(4.2, 3.8))
    angle = np.linspace(0, 2 * np.pi, 721)
    c, s = np.abs(np.cos(angle)), np.abs(np.sin(angle))
    for label, r in (
        ("cone", np.ones_like(angle)),
        ("inscribed pyramid", 1 / (c + s)),
        ("box", 1 / np.maximum(c, s)),
    ):
        axes.plot(r * np.cos(angle), r * np.sin(angle), label=label)
    axes.set(xlabel="λ₁ / μ λₙ", ylabel="λ₂ / μ λₙ", aspect="equal", xlim=(-1.5, 1.5), ylim=(-1.5, 1.5))
    axes.legend(loc="center", fontsize=8)
    return figure


FIGURES = {
    "functions": functions,
    "histories": histories,
    "kostreva": kostreva,
    "lift_off": lift_off,
    "directions": directions,
}


def counts_table():
    """Iterations to a residual of 1e-6 on the columns of CASES."""
    columns = (10, 1), (20, 1), (10, 100), (50, 1000)
    yield "| method | 10 equal | 20 equal | 10, top × 100 | 50, top × 1000 |"
    yield "|---|---|---|---|---|"
    for method in (gauss_seidel, nncg, apgd, min_map_newton, fischer_newton, interior_point):
        cells = []
        for n, heavy in columns:
            problem = LCP_PROBLEMS["column"](n, heavy).problem
            solution = method(problem, tolerance=1e-6, max_iterations=20_000)
            cells.append(str(solution.iterations) if solution.solved else "> 20000")
        yield f"| `{method.__name__}` | {' | '.join(cells)} |"


def residual_table():
    """What a small residual is worth: the error of λ where the residual has come down to so much."""
    cases = (gauss_seidel, 1e-3), (apgd, 1e-3), (apgd, 1e-6)
    yield "| column | Gauss–Seidel, residual 1e-3 | APGD, residual 1e-3 | APGD, residual 1e-6 |"
    yield "|---|---|---|---|"
    for n, heavy in ((10, 1), (10, 100), (50, 1000)):
        known = LCP_PROBLEMS["column"](n, heavy)
        cells = []
        for method, tolerance in cases:
            solution = method(known.problem, tolerance=tolerance, max_iterations=20_000)
            told = f", stopped after 20000 at a residual of {solution.residual:.1g}"
            cells.append(f"{100 * known.error(solution.lam):.2g} %{'' if solution.solved else told}")
        yield f"| {n}, top × {heavy} | {' | '.join(cells)} |"


TABLES = {"counts": counts_table, "residual": residual_table}
