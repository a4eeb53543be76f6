"""Figures and tables of unit 06, pivoting methods for the LCP: lectures/06_pivoting_lcp.md."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Wedge

from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.lcp import dantzig, enumeration, gauss_seidel, lemke, murty

COLOURS = {"w w": "#E69F00", "λ w": "#56B4E9", "w λ": "#009E73", "λ λ": "#CC79A7"}
METHODS = {
    "enumeration": enumeration,
    "murty": murty,
    "dantzig": dantzig,
    "lemke": lemke,
    "lemke, ties='first'": lambda problem, **options: lemke(problem, ties="first", **options),
}
FAMILIES = {
    "Kostreva, n = 3": ("kostreva", {}),
    "Murty's example 2.8, n = 4": ("murty_2_8", {}),
    "Lemke-exponential, n = 8": ("lemke_exponential", {"n": 8}),
    "Murty-exponential, n = 8": ("murty_exponential", {"n": 8}),
    "column of 10 equal boxes": ("column", {"n": 10}),
    "column of 10, the top × 100": ("column", {"n": 10, "heavy": 100}),
}
FAILURES = {
    "no solution": "no_solution",
    "three solutions": "several_solutions",
    "zero diagonal": "zero_diagonal",
    "legs above one point": "redundant",
    "sliding rod that jams": "painleve",
}


def angle(column):
    return np.degrees(np.arctan2(column[1], column[0]))


def draw_cones(axes, A, q):
    """The four cones of a 2 × 2 problem: each spanned by e_i or −A_i, for i = 1, 2; and the point q = b."""
    radius = 2.0
    for k, (name, colour) in enumerate(COLOURS.items()):
        sides = [(-A[:, i] if letter == "λ" else np.eye(2)[i]) for i, letter in enumerate(name.split())]
        first, second = angle(sides[0]), angle(sides[1])
        start, width = (first, second - first) if (second - first) % 360 <= 180 else (second, first - second)
        if abs(width % 360 - 180) < 1:
            continue  # a flat cone: only the line
        wedge = Wedge((0, 0), radius - 0.17 * k, start, start + width % 360, color=colour, alpha=0.45)
        axes.add_patch(wedge)
        middle = np.radians(start + width % 360 / 2)
        at = (radius - 0.17 * k) * 0.82 * np.array([np.cos(middle), np.sin(middle)])
        axes.annotate("$" + name.replace("λ", r"\lambda").replace(" ", r"\,") + "$", at, ha="center")
    for i in (0, 1):
        for way, label in ((np.eye(2)[i], f"$e_{i + 1}$"), (-A[:, i], f"$-A_{i + 1}$")):
            way = way / np.linalg.norm(way)
            axes.plot(*np.transpose([(0, 0), radius * way]), color="0.25", linewidth=1)
            axes.annotate(label, 1.16 * radius * way, ha="center", va="center")
    axes.plot(*q, "k*", markersize=11)
    axes.set(aspect="equal", xlim=(-2.6, 2.6), ylim=(-2.6, 2.6))
    axes.axis("off")


def cones():
    """Complementary cones in the plane: they tile it, overlap, or leave a gap."""
    figure, panels = plt.subplots(1, 3, figsize=(9.6, 3.5))
    shown = {
        "P: each $b$ in one cone": ([[2.0, 1], [1, 2]], (-0.55, -0.6)),
        "not P: $b$ in three cones": ([[1.0, 2], [2, 1]], (-0.6, -0.6)),
        "semidefinite: $b$ in none": ([[1.0, -1], [-1, 1]], (-0.8, -0.8)),
    }
    for axes, (title, (A, q)) in zip(panels, shown.items(), strict=True):
        draw_cones(axes, np.array(A), q)
        axes.set_title(title, fontsize=11)
    return figure


def pivots():
    """Pivots against n: the exponential families, and random P-matrices."""
    figure, axes = plt.subplots(figsize=(6.4, 3.8))
    sizes = np.arange(2, 11)
    lines = {
        "Lemke, Lemke-exponential": (lemke, "lemke_exponential"),
        "least index, Murty-exponential": (murty, "murty_exponential"),
        "least index, Lemke-exponential": (murty, "lemke_exponential"),
    }
    for label, (method, name) in lines.items():
        count = [method(LCP_PROBLEMS[name](n).problem, max_iterations=4096).iterations for n in sizes]
        axes.plot(sizes, count, "o-", label=label)
    for label, method in (("Lemke, random P", lemke), ("least index, random P", murty)):
        axes.plot(sizes, [worst_of_random(method, n) for n in sizes], "s--", label=label)
    axes.set(xlabel="rows n", ylabel="pivots", yscale="log")
    axes.legend(fontsize=8)
    return figure


def worst_of_random(method, n):
    return max(method(LCP_PROBLEMS["planted"]("p", n=n, seed=s).problem).iterations for s in range(10))


def strict_or_fast():
    """Error of λ against work: Gauss–Seidel creeps, a pivoting method is right at its end and not before."""
    figure, axes = plt.subplots(figsize=(6.4, 3.8))
    for heavy, style in ((1, "-"), (100, "--")):
        known = LCP_PROBLEMS["column"](20, heavy)
        sweeps = np.unique(np.geomspace(1, 30000, 40).astype(int))
        errors = [
            known.error(gauss_seidel(known.problem, tolerance=1e-13, max_iterations=int(k)).lam)
            for k in sweeps
        ]
        axes.loglog(sweeps * 20**2, errors, style, color="#0072B2", label=f"Gauss–Seidel, top × {heavy}")
        solution = lemke(known.problem)
        work = solution.iterations * 20 * 22
        error = max(known.error(solution.lam), 1e-16)
        axes.loglog([work, work], [1, error], style, color="#D55E00", label=f"Lemke, top × {heavy}")
        axes.loglog(work, error, "o", color="#D55E00")
    axes.set(xlabel="multiplications, A taken as dense", ylabel="error of λ, relative")
    axes.legend(fontsize=8)
    return figure


def counts():
    """Pivots of each method; ``cycle`` where it goes round."""
    yield "| problem | " + " | ".join(f"`{name}`" for name in METHODS if name != "enumeration") + " |"
    yield "|---|" + "---|" * (len(METHODS) - 1)
    for label, (name, parameters) in FAMILIES.items():
        problem = LCP_PROBLEMS[name](**parameters).problem
        cells = []
        for method in list(METHODS)[1:]:
            solution = METHODS[method](problem, max_iterations=2000)
            cells.append(str(solution.iterations) if solution.solved else solution.status)
        yield f"| {label} | " + " | ".join(cells) + " |"


def failures():
    """What each method says of problems that are none of the easy ones."""
    names = list(METHODS)[:-1]
    yield "| problem | " + " | ".join(f"`{name}`" for name in names) + " |"
    yield "|---|" + "---|" * len(names)
    for label, name in FAILURES.items():
        problem = LCP_PROBLEMS[name]().problem
        yield f"| {label} | " + " | ".join(METHODS[method](problem).status for method in names) + " |"


def tableau():
    """Lemke's method on Kostreva's problem, pivot by pivot."""
    for k, table in enumerate(lemke(LCP_PROBLEMS["kostreva"]().problem, record=True).record):
        yield from ([""] if k else ["```text"])
        yield from str(table).splitlines()
    yield "```"


FIGURES = {"cones": cones, "pivots": pivots, "strict_or_fast": strict_or_fast}
TABLES = {"counts": counts, "failures": failures, "tableau": tableau}
