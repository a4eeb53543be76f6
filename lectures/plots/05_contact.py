"""Figures and tables of unit 05, contact: lectures/05_contact.md."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Polygon as Patch

from lectures.plots import draw_laws, shown
from reference import Box, Disc, Plane, Scene, simulate

G, FRAME = 9.81, 1 / 60
FACES, EDGE = ("#BBD9EA", "#F3D2B3"), "0.25"
ORANGE, GREEN, BLUE = "#D55E00", "#009E73", "#0072B2"


def arrow(axes, start, way, colour, label="", offset=(0.0, 0.0)):
    """An arrow with a label near its tip."""
    style = {"arrowstyle": "-|>", "color": colour, "linewidth": 1.8, "shrinkA": 0, "shrinkB": 0}
    end = np.add(start, way)
    axes.annotate("", end, start, arrowprops=style)
    axes.annotate(label, np.add(end, offset), color=colour, ha="center", va="center", fontsize=12)


def frame():
    """Two bodies about to touch: gap, normal, tangent and arms."""
    figure, axes = plt.subplots(figsize=(6, 3.6))
    lower = np.array([(-2.1, -1.5), (2.1, -1.5), (2.1, 0.0), (-2.1, 0.0)])
    axes.add_patch(Patch(lower, facecolor=FACES[0], edgecolor=EDGE))
    c, s = np.cos(0.5), np.sin(0.5)
    corners = np.array([(0, 0), (2.0, 0), (2.0, 1.2), (0, 1.2)]) @ np.array([[c, s], [-s, c]]) + (-0.6, 0.4)
    axes.add_patch(Patch(corners, facecolor=FACES[1], edgecolor=EDGE))
    point, i, j = np.array([-0.6, 0.2]), np.array([0.0, -0.95]), corners.mean(axis=0)
    for centre, name, at in ((i, "body i", (0.55, -0.15)), (j, "body j", (0.5, 0.1))):
        axes.plot(*centre, "o", color=EDGE, markersize=5)
        axes.annotate(name, centre + at, ha="center", va="center", fontsize=10)
    arrow(axes, i, point - i, BLUE)
    arrow(axes, j, point - j, BLUE)
    axes.annotate("$r_i$", (-0.12, -0.45), color=BLUE, fontsize=12)
    axes.annotate("$r_j$", (-0.2, 0.82), color=BLUE, fontsize=12)
    arrow(axes, point, (0, 1.0), ORANGE, "$n$", (-0.17, 0.0))
    arrow(axes, point, (-1.0, 0.0), ORANGE, "$t$", (-0.15, 0.0))
    axes.annotate("", (-1.0, 0.0), (-1.0, 0.4), arrowprops={"arrowstyle": "<->", "color": GREEN})
    axes.plot([-1.15, -0.6], [0.4, 0.4], color=GREEN, linewidth=1, linestyle=":")
    axes.annotate("gap", (-1.32, 0.42), color=GREEN, ha="center", fontsize=11)
    axes.set(aspect="equal", xlim=(-2.3, 2.3), ylim=(-1.6, 2.4))
    axes.axis("off")
    return figure


def laws():
    """What each law is in the plane of w and λ: a line or a polyline."""
    figure, panels = plt.subplots(1, 4, figsize=(10, 2.7), sharey=True)
    draw = {
        "joint": ([0, 0], [-1, 1]),
        "contact, normal": ([0, 0, 1], [1, 0, 0]),
        "friction": ([-1, 0, 0, 1], [0.6, 0.6, -0.6, -0.6]),
        "motor": ([-1, 0.4, 0.4, 1], [0.6, 0.6, -0.6, -0.6]),
    }
    draw_laws(panels, draw)
    panels[1].annotate("pushes", (0.06, 0.6), fontsize=9)
    panels[1].annotate("leaves", (0.5, 0.08), fontsize=9)
    panels[2].annotate("sticks", (0.06, 0.25), fontsize=9)
    panels[2].annotate("+μ λₙ", (-0.9, 0.7), fontsize=9)
    panels[2].annotate("−μ λₙ", (0.45, -0.52), fontsize=9)
    panels[3].annotate("speed", (0.44, 0.08), fontsize=9)
    panels[3].annotate("max_force", (-0.95, 0.7), fontsize=9)
    return figure


OUTLINES = {  # the corners of what friction may be, over μN; None: the unit circle
    "exact cone": None,
    "pyramid": [(1, 0), (0, 1), (-1, 0), (0, -1)],
    "box": [(1, 1), (-1, 1), (-1, -1), (1, -1)],
}


def nearest(outline, point):
    """The point of the set that is nearest to ``point``: what friction does to a mass point (section 5)."""
    point = np.asarray(point, dtype=float)
    if outline is None:
        return point / max(1.0, np.linalg.norm(point))
    corners = np.array(outline, dtype=float)
    best = point
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        outside = (b - a)[0] * (point - a)[1] - (b - a)[1] * (point - a)[0] < -1e-12
        on_edge = a + np.clip((point - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1) * (b - a)
        if outside and (best is point or np.sum((on_edge - point) ** 2) < np.sum((best - point) ** 2)):
            best = on_edge
    return best


def friction():
    """Cone, pyramid and box: the friction that there may be, and which way one pull makes a mass slide."""
    figure, panels = plt.subplots(1, 3, figsize=(10, 3.7), sharey=True)
    turn = np.linspace(0, 2 * np.pi, 200)
    circle = np.array([np.cos(turn), np.sin(turn)])
    pull = 1.7 * np.array([np.cos(0.5), np.sin(0.5)])
    for axes, (title, outline) in zip(panels, OUTLINES.items(), strict=True):
        shape = circle.T if outline is None else outline
        axes.add_patch(Patch(shape, facecolor=FACES[0], edgecolor=BLUE, linewidth=1.5))
        axes.plot(*circle, color="0.5", linestyle="--", linewidth=1)
        λ = nearest(outline, -pull)
        arrow(axes, (0, 0), pull, GREEN, "pull", (0.05, 0.17))
        arrow(axes, (0, 0), λ, ORANGE, "$\\lambda_t$", (-0.18, -0.12))
        arrow(axes, pull, pull + λ, "k")
        axes.annotate("slides", pull + (pull + λ) / 2 + (0.35, -0.22), fontsize=10, ha="center")
        axes.set(title=title, aspect="equal", xlim=(-1.5, 2.9), ylim=(-1.5, 1.9), xlabel="$t_1$ (μN)")
    panels[0].set_ylabel("$t_2$ (μN)")
    return figure


def ground(slope=0.0):
    """A scene in the plane: a half-space under y = 0; gravity leans by ``slope``, rad, towards +x."""
    scene = Scene(gravity=(G * np.sin(slope), -G * np.cos(slope)))
    scene.add(Plane((0, 1)), friction=1.0)
    return scene


def ball(restitution):
    """A ball of 1 kg whose lowest point is 1 m above the ground."""
    scene = ground()
    scene.add(Disc(0.1), position=(0, 1.1), restitution=restitution)
    return scene


def turned_round(dt, duration, position_first):
    """Energy over time of a mass point that bounces with e = 1, over its energy at first.

    Where it is at the ground at a step's start and comes down, its velocity is turned round; then follows one
    step of symplectic Euler, of either order.
    """
    y, v, energy = 1.0, 0.0, [1.0]
    for _ in range(round(duration / dt)):
        if y <= 0 and v < 0:
            v = -v
        y += dt * v * position_first
        v -= G * dt
        y += dt * v * (not position_first)
        energy.append((0.5 * v * v + G * y) / G)
    return np.array(energy)


def bounce():
    """A ball with e = 1: impacts at steps' starts change its energy; impacts at their own times don't."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2))
    run, dt = simulate(ball(1.0), 3, 1 / 30), 1 / 30
    left.plot(run.time, run.position[:, 1, 1] - 0.1, marker=".", markersize=4)
    left.set(xlabel="time (s)", ylabel="height over the ground (m)")
    energy = run.energy() - G * 0.1
    right.plot(run.time, energy / energy[0], label="impact at its own time")
    for first, name in ((True, "position first"), (False, "velocity first")):
        right.plot(run.time, turned_round(dt, 3, first), label=f"at a step's start, {name}")
    right.set(xlabel="time (s)", ylabel="energy over that at first", ylim=(0, 2.6))
    right.legend(fontsize=8, loc="upper left")
    return figure


FIGURES = {"frame": frame, "laws": laws, "friction": friction, "bounce": bounce}


# --- tables -------------------------------------------------------------------------------------------------


def stack(n, top):
    """n boxes of 1 m and 1 kg on each other; the mass of the last is ``top``."""
    scene = ground()
    for i in range(n):
        scene.add(Box((0.5, 0.5)), mass=top if i == n - 1 else 1.0, position=(0, i + 0.5))
    return scene


def moved(run):
    """The farthest that a body ever is from where it began, m."""
    return np.abs(run.position - run.position[0]).max()


def stack_errors(n, top):
    """How far a stack drifts in 5 s, m, and how wrong the force under each box is, relative."""
    run = simulate(stack(n, top), 5, FRAME, record_every=150)
    contacts, elapsed = run.contacts[-1], run.time[-1] - run.time[-2]
    above = G * (np.arange(n - 1, -1, -1) + top)
    forces = [contacts.impulse[contacts.bodies[:, 1] == j, 0].sum() / elapsed for j in range(1, n + 1)]
    return moved(run), np.max(np.abs(forces - above) / above)


def block_run(share):
    """A block on a slope of 30° for 3 s with μ = share · tan 30°."""
    scene = ground(np.pi / 6)
    scene.add(Box((0.5, 0.5)), position=(0, 0.5), friction=share * np.tan(np.pi / 6))
    return simulate(scene, 3, FRAME)


def measured_table():
    """What the simulator does where the answer is known."""
    yield "| scene | what is known | off by |"
    yield "|---|---|---|"
    for n, top, more in ((10, 1000.0, ", top × 1000"), (20, 1000.0, ", top × 1000"), (50, 1.0, "")):
        drift, force = stack_errors(n, top)
        yield f"| {n} boxes{more}, 5 s | nothing moves | {shown(drift)} m |"
        yield f"| | each is carried by the weight on it | {shown(force)}, relative |"
    yield f"| block on 30°, μ = 1.005 tan θ, 3 s | nothing moves | {shown(moved(block_run(1.005)))} m |"
    run = block_run(0.95)
    way = 0.5 * G * np.sin(np.pi / 6) * 0.05 * run.time**2
    off = np.abs(run.position[:, 1, 0] - way).max()
    yield f"| the same, μ = .95 tan θ | ½ g (sin θ − μ cos θ) t² | {shown(off)} m |"
    scene = ground()
    scene.add(Disc(0.3), position=(0, 0.3), velocity=(2, 0), friction=0.3)
    speed = simulate(scene, 1, FRAME).velocity[-1, 1, 0]
    off = shown(abs(speed - 4 / 3))
    yield f"| disc, slides at 2 m/s, then rolls | 2/3 of the speed is left | {off} m/s |"
    run, rest = simulate(ball(0.5), 2, FRAME), 3 * np.sqrt(2 / G)
    late = np.abs(run.position[run.time > rest, 1, 1] - 0.1).max()
    yield f"| ball, e = ½, from 1 m | rests from 1.3546 s on | {shown(late)} m |"
    energy = simulate(ball(1.0), 6, 1 / 30).energy()
    yield f"| ball, e = 1, Δt = 1/30 s, 6 s | energy stays | {shown(np.ptp(energy) / energy[0])}, relative |"


TABLES = {"measured": measured_table}
