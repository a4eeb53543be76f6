"""Figures and tables of unit 07, iterative methods: lectures/07_iterative_lcp.md."""

import matplotlib.pyplot as plt
import numpy as np

from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.lcp import (
    block_gauss_seidel,
    damped_jacobi,
    gauss_seidel,
    jacobi,
    red_black,
    sor,
    symmetric_gauss_seidel,
)
from reference.lcp.rates import best_omega, error_matrix, measured_rate, rate, sor_rate, sweeps_for

BLUE, ORANGE, GREEN, PURPLE = "#0072B2", "#D55E00", "#009E73", "#CC79A7"
INERTIAS = np.array([1, 0.3, 0.1, 0.03, 0.01])
ASPECTS = np.array([0.25, 0.5, 1, 2, 4, 8, 16])
TOWER = 3  # boxes


def best(n):
    """The best ω on a column of n."""
    return best_omega(np.cos(np.pi / (2 * n)))


def convergence():
    """Residual against sweeps, on a column of ten and on three coupled rows."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4))
    problem = LCP_PROBLEMS["column"](10).problem
    runs = {
        "Jacobi": jacobi(problem, max_iterations=2000),
        "Gauss–Seidel, red–black": red_black(problem),
        "symmetric Gauss–Seidel": symmetric_gauss_seidel(problem),
        "SOR, ω = 1.6": sor(problem),
        "SOR, ω = 1.729 (best)": sor(problem, omega=best(10)),
    }
    for label, solution in runs.items():
        left.semilogy(solution.history, label=label)
    left.set(xlim=(0, 900), ylim=(1e-10, 2), xlabel="iterations", ylabel="residual", title="ten equal boxes")
    left.legend(fontsize=8)
    problem = LCP_PROBLEMS["jacobi_fails"]().problem
    runs = {
        "Jacobi": jacobi(problem, max_iterations=60),
        "damped Jacobi, ω = 0.68": damped_jacobi(problem),
        "Gauss–Seidel": gauss_seidel(problem),
    }
    for label, solution in runs.items():
        right.semilogy(solution.history, label=label)
    right.set(xlim=(0, 60), ylim=(1e-4, 2), xlabel="iterations", title="three rows, coupling 0.9")
    right.legend(fontsize=8, loc="lower left")
    return figure


def spectrum():
    """The eigenvalues of G on a column of ten, and SOR's rate against ω, predicted and measured."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6))
    problem = LCP_PROBLEMS["column"](10).problem
    turn = np.exp(1j * np.linspace(0, 2 * np.pi, 200))
    left.plot(turn.real, turn.imag, color="0.6", linewidth=0.8, linestyle="-")
    methods = (("jacobi", None, "Jacobi", "x"), ("gauss_seidel", None, "Gauss–Seidel", "o"),
               ("sor", best(10), "SOR, best ω", "s"), ("sor", 1.9, "SOR, ω = 1.9", "^"))  # fmt: skip
    for (name, ω, label, marker), colour in zip(methods, (BLUE, ORANGE, GREEN, PURPLE), strict=True):
        values = np.linalg.eigvals(error_matrix(problem, name, omega=ω))
        left.plot(values.real, values.imag, marker, color=colour, markersize=6, fillstyle="none", label=label)
    left.set(aspect="equal", xlabel="real part", ylabel="imaginary part", title="eigenvalues of G")
    left.legend(fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5))
    ωs = np.linspace(0.6, 1.99, 140)
    for n, colour in ((5, BLUE), (10, ORANGE), (20, GREEN)):
        ρ = np.cos(np.pi / (2 * n))
        right.plot(ωs, [sor_rate(ρ, ω) for ω in ωs], "-", color=colour, label=f"{n} boxes")
        some = np.arange(0.7, 2, 0.15)
        right.plot(some, [sor_measured(n, ω) for ω in some], "o", color=colour, markersize=4)
    right.axvline(1.6, color="0.5", linewidth=0.8, linestyle=":")
    right.set(xlabel="ω", ylabel="rate", ylim=(0.2, 1.02), title="SOR: line predicted, dots measured")
    right.legend(fontsize=8, loc="lower left")
    return figure


def sor_measured(n, ω):
    """The rate of a run of SOR on a column, over its last half."""
    solution = sor(LCP_PROBLEMS["column"](n).problem, omega=ω, tolerance=1e-12, max_iterations=20_000)
    return measured_rate(solution, max(1, solution.iterations // 2))


def sweeps_measured(problem, method, **options):
    """Sweeps from a residual of 1e-3 to one of 1e-9: a factor of 1e-6, past the beginning."""
    history = method(problem, tolerance=1e-9, max_iterations=1_000_000, **options).history
    first = np.flatnonzero(history <= 1e-3)[0]
    reached = np.log(history[-1] / history[first])
    return (len(history) - 1 - first) * np.log(1e-6) / reached


def slow():
    """S15: sweeps for a factor of 1e-6 against aspect ratio and inertia, predicted and measured."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4), sharey=True)
    studies = (
        ("height / width of a box", ASPECTS, lambda x: (TOWER, x)),
        ("inertia / that of a full box", INERTIAS, lambda x: (TOWER, 1.0, x)),
    )
    for chart, (label, values, arguments) in zip(axes, studies, strict=True):
        for name, method, options, colour, words in methods_on_towers():
            problems = [LCP_PROBLEMS["tower"](*arguments(x)).problem for x in values]
            predicted = [sweeps_for(rate(problem, name, **options)) for problem in problems]
            inner = {"inner": 2000} if options else {}
            measured = [sweeps_measured(problem, method, **options, **inner) for problem in problems]
            chart.loglog(values, predicted, "-", color=colour, label=f"{words}, predicted")
            chart.loglog(values, measured, "o", color=colour, markersize=5, label="measured")
        chart.set(xlabel=label)
    axes[0].set(ylabel="sweeps for a factor of 1e-6")
    axes[1].invert_xaxis()
    axes[1].legend(fontsize=8)
    return figure


def methods_on_towers():
    """Gauss–Seidel, and the same with the two contacts below a box as one block."""
    blocks = np.arange(2 * TOWER) // 2
    return (
        ("gauss_seidel", gauss_seidel, {}, ORANGE, "row by row"),
        ("block_gauss_seidel", block_gauss_seidel, {"blocks": blocks}, BLUE, "box by box"),
    )


def residual_and_error():
    """Fifty boxes, the top one × 1000: the residual falls at once, the error of λ hardly at all."""
    known = LCP_PROBLEMS["column"](50, 1000)
    figure, chart = plt.subplots(figsize=(7, 3.4))
    counts = np.unique(np.geomspace(1, 20_000, 40).astype(int))
    for method, options, colour, words in (
        (gauss_seidel, {}, ORANGE, "Gauss–Seidel"),
        (sor, {"omega": 1.9}, BLUE, "SOR, ω = 1.9"),
    ):
        runs = [method(known.problem, tolerance=1e-12, max_iterations=int(k), **options) for k in counts]
        chart.loglog(
            counts, [known.error(run.lam) for run in runs], "-", color=colour, label=f"error of λ, {words}"
        )
        chart.loglog(counts, [run.residual for run in runs], "--", color=colour, label=f"residual, {words}")
    chart.set(xlabel="sweeps", ylabel="relative error", ylim=(5e-5, 2))
    chart.legend(fontsize=8, loc="lower left")
    return figure


FIGURES = {
    "convergence": convergence,
    "spectrum": spectrum,
    "slow": slow,
    "residual_and_error": residual_and_error,
}


# --- tables -------------------------------------------------------------------------------------------------


def rates_table():
    """Predicted and measured rates side by side, and what they come to in sweeps."""
    yield "| ten equal boxes | closed form | from the spectrum | measured | iterations to 1e-6 |"
    yield "|---|---|---|---|---|"
    n, problem = 10, LCP_PROBLEMS["column"](10).problem
    ρ = np.cos(np.pi / (2 * n))
    rows = (
        ("Jacobi", "jacobi", jacobi, {}, "cos(π/2n)", ρ),
        ("Gauss–Seidel", "gauss_seidel", gauss_seidel, {}, "cos²(π/2n)", ρ**2),
        ("red–black", "red_black", red_black, {}, "cos²(π/2n)", ρ**2),
        ("symmetric Gauss–Seidel", "symmetric_gauss_seidel", symmetric_gauss_seidel, {}, "", None),
        ("SOR, ω = 1.5", "sor", sor, {"omega": 1.5}, "Young", sor_rate(ρ, 1.5)),
        ("SOR, ω = 1.6", "sor", sor, {"omega": 1.6}, "Young", sor_rate(ρ, 1.6)),
        ("SOR, ω = 1.8", "sor", sor, {"omega": 1.8}, "ω − 1", 0.8),
    )
    for label, name, method, options, formula, closed in rows:
        spectral = rate(problem, name, **options)
        fine = method(problem, tolerance=1e-12, max_iterations=10_000, **options)
        count = method(problem, tolerance=1e-6, max_iterations=10_000, **options).iterations
        value = f"{formula} = {closed:.4f}" if closed else "none"
        measured = measured_rate(fine, fine.iterations // 2)
        yield f"| {label} | {value} | {spectral:.4f} | {measured:.3f} | {count} |"


def slow_table():
    """One box on two contacts: κ, rate, sweeps, predicted and measured."""
    yield "| one box on two contacts | κ | rate ((1 − κ)/(1 + κ))² | sweeps for 1e-6, predicted | measured |"
    yield "|---|---|---|---|---|"
    cases = (
        ("as high as wide", 1, 1),
        ("4 times as high", 4, 1),
        ("16 times as high", 16, 1),
        ("as high as wide, inertia × 0.1", 1, 0.1),
        ("as high as wide, inertia × 0.01", 1, 0.01),
    )
    for label, aspect, inertia in cases:
        κ = 3 / (1 + aspect**2) / inertia
        ρ = ((1 - κ) / (1 + κ)) ** 2
        measured = sweeps_measured(LCP_PROBLEMS["tower"](1, aspect, inertia).problem, gauss_seidel)
        yield f"| {label} | {κ:.3g} | {ρ:.4f} | {sweeps_for(ρ):.3g} | {measured:.3g} |"


def error_table():
    """What is left wrong where the residual looks small."""
    yield "| Gauss–Seidel, 50 boxes | residual | largest r over largest λ | error of λ |"
    yield "|---|---|---|---|"
    studies = ("equal", 1, (100, 1000, 4000)), ("top × 1000", 1000, (100, 1000, 10_000, 100_000))
    for words, heavy, counts in studies:
        known = LCP_PROBLEMS["column"](50, heavy)
        for count in counts:
            solution = gauss_seidel(known.problem, tolerance=1e-12, max_iterations=count)
            r = solution.residual * known.problem.scale / solution.lam.max()
            error = known.error(solution.lam)
            yield f"| {words}, {count} sweeps | {solution.residual:.1e} | {r:.1e} | {100 * error:.2g} % |"


TABLES = {"rates": rates_table, "slow": slow_table, "error": error_table}
