"""Figures and tables of unit 03, the Jacobian: lectures/03_jacobian.md."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Polygon as Patch

from lectures.plots import draw_laws, shown
from reference import BallJoint, Box, Distance, Fixed, Hinge, Polygon, Scene, Slider, Universal
from reference.correction import displace
from reference.joints import ANGULAR, DISTANCE, LINEAR
from reference.layout import Bodies
from reference.mechanism import rigid_rows
from reference.rows import dense, fill_rows, make_jacobian

FACES, EDGE = ("#BBD9EA", "#F3D2B3"), "0.25"
ORANGE, GREEN, BLUE = "#D55E00", "#009E73", "#0072B2"


def turned(angle, points):
    """Points (…, 2) turned about the origin."""
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(points, dtype=float) @ np.array([[c, s], [-s, c]])


def arrow(axes, start, way, colour, label="", offset=(0.0, 0.0), width=1.8, **text):
    """An arrow with a label at its tip."""
    style = {"arrowstyle": "-|>", "color": colour, "linewidth": width, "shrinkA": 0, "shrinkB": 0}
    end = np.add(start, way)
    axes.annotate("", end, start, arrowprops=style)
    axes.annotate(label, end + offset, color=colour, ha="center", va="center", fontsize=12, **text)


def two_bodies(axes, gap=(0.0, 0.0)):
    """Two links joined at the origin; returns their centres. gap: from i's point to j's."""
    outline = np.array([(-1.1, -0.28), (1.1, -0.28), (1.1, 0.28), (-1.1, 0.28)])
    centres = []
    for face, angle, way, name, at in (
        (FACES[0], 0.25, -0.85, "body i", (0, 0)),
        (FACES[1], -0.6, 0.85, "body j", gap),
    ):
        centre = turned(angle, (way, 0.0)) + at
        axes.add_patch(Patch(centre + turned(angle, outline), facecolor=face, edgecolor=EDGE))
        axes.plot(*centre, "o", color=EDGE, markersize=5)
        end = centre + turned(angle, (0.7 * np.sign(way), 0.0))
        axes.annotate(name, end, rotation=np.degrees(angle), ha="center", va="center", fontsize=10)
        centres.append(centre)
    axes.plot(0, 0, "o", color="k", markersize=7)
    axes.set(aspect="equal", xlim=(-2.3, 2.3), ylim=(-1.75, 1.2))
    axes.axis("off")
    return centres


def hinge():
    """The hinge: arms and the joint's own frame; and what one λ does to both bodies."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4))
    i, j = two_bodies(left)
    arrow(left, i, -i, BLUE, "$r_i$", i / 2 + (-0.02, -0.17))
    arrow(left, j, -j, BLUE, "$r_j$", j / 2 + (-0.17, -0.1))
    for k, label in enumerate(("$e_1$", "$e_2$")):
        way = turned(0.25, np.eye(2)[k])
        arrow(left, (0, 0), 0.8 * way, ORANGE, label, 0.17 * way)
    left.plot(0, 0, "o", color=ORANGE, markersize=13, fillstyle="none", markeredgewidth=1.5)
    left.annotate("$e_3$", (-0.33, 0.08), color=ORANGE, ha="center", fontsize=12)
    left.set_title("arms, and the joint's own frame", fontsize=11)

    i, j = two_bodies(right)
    push = turned(0.25, (0, 0.75))
    arrow(right, (0, 0), push, ORANGE, r"$\lambda e_2$", (0.35, 0.05))
    arrow(right, (0, 0), -push, ORANGE, r"$-\lambda e_2$", (0.1, -0.17))
    arrow(right, j, push, GREEN, r"$f_j$", (0.18, 0.0))
    arrow(right, i, -push, GREEN, r"$f_i$", (0.22, 0.0))
    for centre, label, at in ((i, r"$\tau_i$", (0.05, 0.33)), (j, r"$\tau_j$", (0.42, 0.1))):
        bend = {"arrowstyle": "-|>", "color": GREEN, "linewidth": 1.8, "connectionstyle": "arc3,rad=-0.7"}
        right.annotate("", centre + (0.3, 0.0), centre + (-0.3, 0.0), arrowprops=bend)
        right.annotate(label, centre + at, color=GREEN, ha="center", va="center", fontsize=12)
    right.set_title(r"$f_c = J^{\mathsf{T}}\lambda$: forces and torques on both", fontsize=11)
    return figure


def plane():
    """What each law is in the plane of w and λ."""
    figure, panels = plt.subplots(1, 5, figsize=(10.5, 2.5), sharey=True)
    draw = {
        "free: λ = 0": ([-1, 1], [0, 0]),
        "joint: w = 0": ([0, 0], [-1, 1]),
        "spring and damper": ([-1, 1], [0.75, -0.35]),
        "motor": ([-1, 0.4, 0.4, 1], [0.6, 0.6, -0.6, -0.6]),
        "limit, while it touches": ([0, 0, 1], [1, 0, 0]),
    }
    draw_laws(panels, draw)
    panels[3].annotate("speed", (0.44, 0.08), fontsize=9)
    panels[3].annotate("max_force", (-0.95, 0.68), fontsize=9)
    panels[2].annotate("slope −damping", (-0.3, 0.5), fontsize=9)
    return figure


# --- J and J̇u by finite differences -------------------------------------------------------------------------


def pair(joint, d=3):
    """Two bodies of full inertia at an angle, joined: (bodies, rows, state with some velocities)."""
    scene = Scene(gravity=np.zeros(d))
    for k in range(2):
        shape = Box((0.3, 0.4, 0.5)) if d == 3 else Polygon([(0, 0), (1, 0), (0, 0.7)])
        position = np.array([0.3 - k, 0.8 * k, 0.2 * k])[:d]
        turn = np.array([4.0, 1 - k, 0.5, k]) / np.linalg.norm([4.0, 1 - k, 0.5, k])
        scene.add(shape, position=position, orientation=turn if d == 3 else 0.4 - k, group="pair")
    scene.join(joint)
    bodies = Bodies(scene)
    state = bodies.state()
    state.u[:] = np.sin(1 + np.arange(state.u.size))  # about 1, and anything but special
    return bodies, rigid_rows(bodies), state


def filled(bodies, rows, state):
    """The Jacobian of the rows, and J as a matrix."""
    out = make_jacobian(len(rows.kind), len(bodies.rotating), bodies.dimension)
    fill_rows(rows, state, out)
    return out, dense(out.J, rows.bodies, len(bodies.moving), len(bodies.rotating))


def φ_after(bodies, rows, state, t):
    """φ after the time t at constant u."""
    moved = bodies.state()
    moved.y[:] = state.y
    displace(moved, t * state.v, t * state.ω)
    return filled(bodies, rows, moved)[0].φ


def difference_errors(bodies, rows, state, h):
    """How far J u and J̇ u are from central differences of φ with the step h."""
    out, J = filled(bodies, rows, state)
    before, now, later = (φ_after(bodies, rows, state, t) for t in (-h, 0.0, h))
    first, second = (later - before) / (2 * h), (later - 2 * now + before) / h**2
    return np.max(np.abs(first - J @ state.u)), np.max(np.abs(second - out.rate))


P, Z, Y = (0.2, 0.4, 0.1), (0, 0, 1), (0, 1, 0)
SPACE = {
    "BallJoint": BallJoint(0, 1, point=P),
    "Hinge": Hinge(0, 1, point=P, axis=(1, 2, 2)),
    "Slider": Slider(0, 1, axis=(1, 2, 2)),
    "Fixed": Fixed(0, 1),
    "Universal": Universal(0, 1, point=P, axis_a=Z, axis_b=Y),
    "Distance": Distance(0, 1, point_a=P, point_b=(1, 1, 1)),
}
PLANE = {
    "Hinge": Hinge(0, 1, point=P[:2]),
    "Slider": Slider(0, 1, axis=(1, 2)),
    "Fixed": Fixed(0, 1),
    "Distance": Distance(0, 1, point_a=P[:2], point_b=(1, 1)),
}


def differences():
    """The error of finite differences against their step: truncation on the right, rounding on the left."""
    figure, axes = plt.subplots(figsize=(7.5, 3.6))
    bodies, rows, state = pair(SPACE["Hinge"])
    steps = 0.3 / 2.0 ** np.arange(0, 34)
    first, second = np.transpose([difference_errors(bodies, rows, state, h) for h in steps])
    axes.loglog(steps, first, marker="o", markersize=3, label="first difference of φ against w = J u")
    axes.loglog(steps, second, marker="s", markersize=3, label="second difference of φ against its rate")
    axes.loglog(
        steps[:16], first[0] * (steps[:16] / steps[0]) ** 2, color="0.3", linewidth=4, alpha=0.3, label="h²"
    )
    axes.set(xlabel="h (s)", ylabel="error (m/s, m/s² and rad)", ylim=(1e-12, 1e2))
    axes.legend(fontsize=8, loc="upper right", bbox_to_anchor=(0.8, 1))
    return figure


def opening():
    """A rod's φ at constant u: w = 0 at first, and the rod grows all the same."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.5, 3.2), width_ratios=(1, 1.5))
    turn, t = np.linspace(-0.1, 1.3, 80), np.linspace(0, 1, 60)
    left.plot(np.sin(turn), -np.cos(turn), color="grey", linewidth=1, label="where the rod lets it go")
    left.plot([0, 0], [0, -1], color=EDGE, linestyle="-", linewidth=2)
    left.plot(t, -np.ones_like(t), color=ORANGE, linestyle="--", label="at constant u")
    left.plot(0, -1, "o", color=BLUE, markersize=9)
    left.plot(0, 0, "^", color=EDGE, markersize=9)
    left.plot([0, 0.75], [0, -1], color=ORANGE, linestyle=":", linewidth=1.5)
    left.set(aspect="equal", xlabel="x (m)", ylabel="y (m)", xlim=(-0.25, 1.1), ylim=(-1.15, 0.45))
    left.legend(fontsize=8, loc="upper right")
    right.plot(t, np.hypot(1, t) - 1, color=ORANGE, linestyle="-", label="φ at constant u")
    right.plot(t, 0.5 * t**2, color="grey", linestyle="--", label="½ · rate · t²")
    right.set(xlabel="time (s)", ylabel="φ (m)")
    right.legend()
    return figure


FIGURES = {"hinge": hinge, "plane": plane, "opening": opening, "differences": differences}


# --- tables -------------------------------------------------------------------------------------------------

NAMES = {LINEAR: "LINEAR", ANGULAR: "ANGULAR", DISTANCE: "DISTANCE"}


def kinds_table():
    """Of each joint: its rows, their rank, and how far J u and J̇u are from finite differences."""
    yield "| joint | rows | rank of J | left free | J u − first difference | J̇u − second difference |"
    yield "|---|---|---|---|---|---|"
    for d, joints in ((3, SPACE), (2, PLANE)):
        for name, joint in joints.items():
            bodies, rows, state = pair(joint, d)
            counts = {NAMES.get(kind, "TURN"): np.sum(rows.kind == kind) for kind in dict.fromkeys(rows.kind)}
            words = ", ".join(f"{count} {kind}" for kind, count in counts.items())
            rank = np.linalg.matrix_rank(filled(bodies, rows, state)[1])
            first = difference_errors(bodies, rows, state, 1e-5)[0]
            second = difference_errors(bodies, rows, state, 1e-4)[1]
            yield (
                f"| `{name}` {'in space' if d == 3 else 'in the plane'} | {words} | {rank} "
                f"| {(6 if d == 3 else 3) - rank} | {shown(first)} "
                f"| {'< 1e-6' if second < 1e-6 else shown(second)} |"
            )


TABLES = {"kinds": kinds_table}
