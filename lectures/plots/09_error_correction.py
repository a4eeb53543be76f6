"""Figures and tables of unit 09, error correction: lectures/09_error_correction.md."""

import time

import matplotlib.pyplot as plt
import numpy as np

from lectures.plots import draw_laws, shown
from reference import Box, Disc, Distance, Plane, Scene, Simulation, simulate

G, FRAME = 9.81, 1 / 60
FRACTION, DEPTH = 0.2, 0.1
STYLES = {"none": "-", "baumgarte": "--", "split_impulse": "-.", "nonlinear": ":", "soft": (0, (5, 1, 1, 1))}
ORANGE, GREEN, BLUE = "#D55E00", "#009E73", "#0072B2"


def ground():
    """A scene in the plane over a half-space."""
    scene = Scene(gravity=(0, -G))
    scene.add(Plane((0, 1)))
    return scene


# --- a ball that was put into the ground --------------------------------------------------------------------


def sunken_ball():
    """A ball of 1 kg, 10 cm deep in the ground, at rest."""
    scene = ground()
    scene.add(Disc(0.5), position=(0, 0.5 - DEPTH))
    return scene


def ball():
    """How the five lift a ball out; how high Baumgarte's method throws it as the step shrinks."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.3))
    for name, style in STYLES.items():
        run = simulate(sunken_ball(), 0.5, FRAME, correction=name)
        left.plot(run.time, 100 * (run.position[:, 1, 1] - 0.5), linestyle=style, label=name)
    left.set(xlabel="time (s)", ylabel="height over the ground (cm)", title="step of 1/60 s", ylim=(-11, 6))
    left.legend(fontsize=8, ncols=2, loc="upper center")
    left.axhline(0, color="0.6", linewidth=0.8)
    for rate, style in ((60, "-"), (120, "--"), (240, ":")):
        law = ("baumgarte", {"fraction": FRACTION, "slop": 0.0})
        run = simulate(sunken_ball(), 1.2, 1 / rate, correction=law)
        right.plot(run.time, run.position[:, 1, 1] - 0.5, linestyle=style, label=f"step of 1/{rate} s")
    right.axhline(0, color="0.6", linewidth=0.8)
    right.set(xlabel="time (s)", ylabel="height over the ground (m)", title="Baumgarte")
    right.legend(fontsize=8)
    return figure


# --- the laws in the plane of w and λ -----------------------------------------------------------------------


def laws():
    """A row whose error is φ > 0, in the plane of w and λ: rigid, fed back, soft; and a soft contact."""
    figure, panels = plt.subplots(1, 4, figsize=(10, 2.7), sharey=True)
    draw = {
        "rigid row": ([0, 0], [-1, 1]),
        "Baumgarte": ([-0.4, -0.4], [-1, 1]),
        "soft row": ([0.1, -0.9], [-1, 1]),
        "soft contact, d deep": ([1, 0.4, -0.1], [0, 0, 1]),
    }
    draw_laws(panels, draw)
    panels[1].annotate("−share φ/h", (-0.35, -0.6), fontsize=9)
    panels[2].annotate("−share φ/h", (-0.33, 0.1), fontsize=9)
    panels[2].annotate("slope −1/γ", (0.05, -0.75), fontsize=9)
    panels[3].annotate("share d/h", (0.4, -0.25), fontsize=9)
    return figure


# --- a chain, and the number of substeps --------------------------------------------------------------------

LINK = 0.5


def hang_chain(scene, n, anchor, level=True, heavy=1.0):
    """n discs of 1 kg, the last of ``heavy``, on links of half a metre: level, or straight down."""
    way, before = np.array([1.0, 0.0]) if level else np.array([0.0, -1.0]), None
    for k in range(n):
        mass = heavy if k == n - 1 else 1.0
        i = scene.add(Disc(0.05), mass=mass, position=anchor + LINK * (k + 1) * way, friction=0)
        scene.join(Distance(i, None, point_b=anchor) if k == 0 else Distance(before, i))
        before = i


def worst_gap(correction, substeps, **settings):
    """The worst that a link of a swinging chain of three is off its length in 2 s, m."""
    scene = Scene(gravity=(0, -G))
    hang_chain(scene, 3, (0, 0))
    run = simulate(
        scene, 2, FRAME, simulator="velocity_lcp", correction=correction, substeps=substeps, **settings
    )
    return run.joint_error().max()


def substeps():
    """The worst gap of a swinging chain against the number of substeps, for each correction."""
    figure, axes = plt.subplots(figsize=(6.2, 3.8))
    counts = np.array([1, 2, 4, 8])
    for (name, style), mark in zip(STYLES.items(), "os^vD", strict=True):
        gaps = [worst_gap(name, int(n)) for n in counts]
        axes.loglog(counts, gaps, marker=mark, markersize=4, linestyle=style, label=name)
    axes.loglog(counts[1:], 0.3 / counts[1:], color="0.6", linewidth=1, linestyle="-")
    axes.annotate("order 1", (4.2, 0.08), fontsize=9, color="0.4")
    axes.loglog(counts[1:], 0.006 / counts[1:] ** 2, color="0.6", linewidth=1, linestyle="-")
    axes.annotate("order 2", (4.2, 4e-4), fontsize=9, color="0.4")
    axes.set(xlabel="substeps in 1/60 s", ylabel="worst gap in 2 s (m)", xticks=counts)
    axes.set_xticklabels([str(n) for n in counts])
    axes.minorticks_off()
    axes.legend(fontsize=8)
    return figure


# --- all of them on one scene -------------------------------------------------------------------------------

BOXES, SINK, LINKS = 5, 0.02, 3
SETTINGS = (
    ("none", 1),
    ("baumgarte", 1),
    ("split_impulse", 1),
    ("nonlinear", 1),
    ("soft", 1),
    ("projection", 1),
    ("none", 4),
    ("baumgarte", 4),
    ("soft", 4),
)
SOLVES = {
    "none": "1",
    "baumgarte": "1",
    "split_impulse": "2",
    "nonlinear": "1, and 3 sweeps",
    "soft": "1, softened",
    "projection": "1, and Newton's",
}


def stack_and_chain():
    """Five boxes of 1 kg, each 2 cm deep in what is below it, and far from them a chain let go level."""
    scene = ground()
    for k in range(BOXES):
        scene.add(Box((0.5, 0.5)), position=(0, k + 0.5 - SINK * (k + 1)))
    hang_chain(scene, LINKS, (5, 3))
    return scene


def overlap(run):
    """(T,): the deepest overlap within the stack or with the ground, m, by the boxes' heights."""
    y = run.position[:, 1 : BOXES + 1, 1]
    below = np.concatenate([np.full((len(y), 1), -0.5), y[:, :-1]], axis=1)
    return np.maximum(1 - (y - below), 0).max(axis=1)


def stack_energy(run):
    """(kinetic, added), (T,) each, J: the stack's kinetic energy, and all its energy less that of the start.

    The start is the scene's, not the first record, which under "projection" is lifted already.
    """
    v, ω, x = (part[:, 1 : BOXES + 1] for part in (run.velocity, run.angular_velocity, run.position))
    kinetic = 0.5 * (v**2).sum(axis=(1, 2)) + (ω**2).sum(axis=1) / 12  # I = m (1² + 1²)/12
    k = np.arange(BOXES)
    return kinetic, kinetic + G * (x[:, :, 1] - (k + 0.5 - SINK * (k + 1))).sum(axis=1)


def corrected(name, substeps, duration=3):
    """The run of the scene."""
    return simulate(stack_and_chain(), duration, FRAME, correction=name, substeps=substeps)


def scene():
    """Overlap and joint gap over time on the one scene."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4))
    for name, style in STYLES.items():
        run = corrected(name, 1)
        left.semilogy(run.time, np.maximum(overlap(run), 1e-6), linestyle=style, label=name)
        right.semilogy(run.time[1:], run.joint_error()[1:], linestyle=style, label=name)
    left.set(xlabel="time (s)", ylabel="deepest overlap of the stack (m)", ylim=(8e-7, 0.1))
    right.set(xlabel="time (s)", ylabel="worst gap of the chain (m)")
    right.legend(fontsize=8)
    return figure


def measured_table():
    """Drift, energy and number of solves of each correction on the one scene."""
    yield (
        "| correction | substeps | overlap after ¼ s, m | after 3 s, m | kinetic energy, J "
        "| energy added, J | worst joint gap, m | solves a substep |"
    )
    yield "|---|---|---|---|---|---|---|---|"
    for name, n in SETTINGS:
        run = corrected(name, n)
        deep, gap = overlap(run), run.joint_error().max()
        energies = " | ".join(f"{abs(part.max()):.1f}" for part in stack_energy(run))
        lengths = f"{shown(deep[round(0.25 / FRAME)])} | {shown(deep[-1])}"
        yield f"| `{name}` | {n} | {lengths} | {energies} | {shown(gap)} | {SOLVES[name]} |"


def cost_lines():
    """CPU time of half a second over that of ``none``, medians of five, taken in turns: as text, since no two
    machines agree.
    """
    times = {setting: [] for setting in SETTINGS}
    for _ in range(5):
        for name, n in SETTINGS:
            run = Simulation(stack_and_chain(), FRAME, correction=name, substeps=n)
            start = time.process_time()
            run.advance(0.5)
            times[name, n].append(time.process_time() - start)
    least = np.median(times["none", 1])
    for (name, n), spans in times.items():
        yield f"CPU time, {name}, substeps {n}: {np.median(spans) / least:.1f} times that of none, 1"


def hanging_gap(correction, sweeps, n):
    """The worst gap, m, after 1 s of a chain that hangs under 100 kg, with so many sweeps in each substep."""
    scene = Scene(gravity=(0, -G))
    hang_chain(scene, 10, (0, 0), level=False, heavy=100.0)
    settings = {"simulator": "velocity_lcp", "friction": "box", "solver": "gauss_seidel"}
    run = simulate(scene, 1, FRAME, iterations=sweeps, correction=correction, substeps=n, **settings)
    return run.joint_error()[-1]


def sweeps_table():
    """Sixteen sweeps in one step, or one in each of sixteen substeps; 48 over the positions likewise."""
    yield "| sweeps a substep | substeps | gap, `none`, m | gap, `nonlinear`, m |"
    yield "|---|---|---|---|"
    for sweeps, n in ((16, 1), (4, 4), (1, 16)):
        nonlinear = ("nonlinear", {"sweeps": 3 * sweeps})
        gaps = (shown(hanging_gap(correction, sweeps, n)) for correction in ("none", nonlinear))
        yield f"| {sweeps} | {n} | {' | '.join(gaps)} |"


FIGURES = {"ball": ball, "laws": laws, "substeps": substeps, "scene": scene}
TABLES = {"measured": measured_table, "sweeps": sweeps_table, "cost": cost_lines}
