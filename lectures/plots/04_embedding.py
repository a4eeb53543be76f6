"""Figures and tables of unit 04, embedding: lectures/04_embedding.md."""

import matplotlib.pyplot as plt
import numpy as np
import scipy.sparse

from lectures.plots import shown
from reference import BallJoint, Box, Scene, model, simulate
from reference.cases import CASES
from reference.equation import FORMS, equation, solve_kkt, solve_schur

ORANGE, GREEN, BLUE = "#D55E00", "#009E73", "#0072B2"
G = 9.81  # m/s²


def star(arms):
    """A hub in space that carries arms on ball joints."""
    scene = Scene()
    hub = scene.add(Box((1.0, 1.0, 1.0)), group="star")
    for angle in 2 * np.pi * np.arange(arms) / arms:
        way = np.array([np.cos(angle), np.sin(angle), np.sin(2 * angle) / 2])
        arm = scene.add(Box((0.4, 0.1, 0.1)), position=1.5 * way, group="star")
        scene.join(BallJoint(hub, arm, point=way))
    return scene


SCENES = {
    "pendulum": lambda: CASES["pendulum"]().scene,
    "four-bar linkage": lambda: CASES["four_bar"]().scene,
    "chain of 20, in the plane": lambda: CASES["chain"]().scene,
    "chain of 20, ball joints": lambda: CASES["chain"](dimension=3, joint="ball").scene,
    "star of 20, ball joints": lambda: star(20),
}


# --- figures ------------------------------------------------------------------------------------------------


def pattern():
    """Where the numbers are: the whole system, and A, of a chain and of a star."""
    figure, panels = plt.subplots(1, 4, figsize=(10.5, 3.0))
    for axes, (scene, title) in zip(
        panels[::2], ((CASES["chain"](n=8).scene, "chain of 8"), (star(5), "star of 5")), strict=True
    ):
        made = equation(scene, form="sparse")
        m = len(made.b)
        whole = scipy.sparse.block_array([[made.M, -made.J.T], [made.J, scipy.sparse.csr_array((m, m))]])
        other = panels[list(panels).index(axes) + 1]
        for panel, matrix, name in ((axes, whole, "whole system"), (other, made.A, "A")):
            panel.imshow(np.abs(matrix.toarray()) > 1e-9, cmap="Blues", vmin=0, vmax=1.3)
            panel.set_title(f"{title}: {name}, {matrix.shape[0]}²", fontsize=9)
            panel.set(xticks=[], yticks=[])
            panel.grid(False)
    return figure


def rod_pendulum(step, h, duration):
    """(time, length − 1, energy gained) of a point of 1 kg on a rod of 1 m, let go level."""
    y, kept = np.array([1.0, 0.0, 0.0, 0.0]), []
    steps = round(duration / h)
    for _ in range(steps):
        kept.append(y)
        y = step(y, h)
    kept = np.array(kept)
    energy = 0.5 * np.sum(kept[:, 2:] ** 2, axis=1) + G * kept[:, 1]
    return h * np.arange(steps), np.hypot(kept[:, 0], kept[:, 1]) - 1, energy


def rod_rate(y):
    """ẏ with the rod's λ at the level of accelerations."""
    x, u = y[:2], y[2:]
    r = np.hypot(*x)
    J, rate = x / r, (u @ u - (x @ u / r) ** 2) / r
    λ = -(J @ (0, -G) + rate)
    return np.concatenate([u, (0, -G) + J * λ])


def rk4(y, h):
    k1 = rod_rate(y)
    k2 = rod_rate(y + h / 2 * k1)
    k3 = rod_rate(y + h / 2 * k2)
    k4 = rod_rate(y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def rk4_projected(y, h):
    y = rk4(y, h)
    x = y[:2] / np.hypot(*y[:2])
    return np.concatenate([x, y[2:] - x * (x @ y[2:])])


def velocity_step(share):
    """A step at the level of velocities, with so large a share of the gap taken back."""

    def step(y, h):
        x, u = y[:2], y[2:] + (0, -h * G)
        r = np.hypot(*x)
        u = u - x / r * (x @ u / r + share * (r - 1) / h)
        return np.concatenate([x + h * u, u])

    return step


def drift():
    """How a rod's length drifts, by level and correction."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4))
    for label, step, style in (
        ("velocities", velocity_step(0.0), "-"),
        ("velocities, share 0.2", velocity_step(0.2), "--"),
        ("accelerations, RK4", rk4, "-."),
        ("accelerations, RK4, projected", rk4_projected, ":"),
    ):
        time, gap, energy = rod_pendulum(step, 0.02, 20.0)
        left.semilogy(time, np.maximum(np.abs(gap), 1e-17), linestyle=style, linewidth=1.2, label=label)
        right.semilogy(time, np.maximum(np.abs(energy), 1e-9), linestyle=style, linewidth=1.2, label=label)
    left.set(xlabel="time (s)", ylabel="|length − 1| (m)")
    right.set(xlabel="time (s)", ylabel="|energy gained| (J)")
    left.legend(fontsize=7, loc="center right")
    return figure


FIGURES = {"pattern": pattern, "drift": drift}


# --- tables -------------------------------------------------------------------------------------------------


def forms_table():
    """How large each form is, and how far their accelerations are from one another."""
    yield "| scene, in motion | N | m | numbers in M and J | in A | of m² | forms and whole system differ |"
    yield "|---|---|---|---|---|---|---|"
    for name, make in SCENES.items():
        scene = make()
        state = simulate(scene, 0.1, 0.01).state()
        forms = [equation(scene, state, form=form) for form in FORMS]
        sparse = forms[1]
        x, _ = solve_kkt(sparse)
        apart = max(np.abs(solve_schur(made)[0] - x).max() for made in forms) / np.abs(x).max()
        m = len(sparse.b)
        stored, share = np.count_nonzero(sparse.A.toarray()), np.count_nonzero(sparse.A.toarray()) / m**2
        yield (
            f"| {name} | {len(x)} | {m} | {sparse.M.nnz + sparse.J.nnz} | {stored} | {100 * share:.0f} % "
            f"| {'< 1e-8' if apart < 1e-8 else shown(apart)} |"
        )


def errors_table():
    """The double pendulum and the heavy chain: errors by the step."""
    yield "| scene, 2 s | h | tip, relative | energy, of what was exchanged | worst joint |"
    yield "|---|---|---|---|---|"
    for name, label, parameters, steps in (
        ("double_pendulum", "double pendulum", {}, (50, 100, 200, 400, 800)),
        ("chain", "chain of 100, end mass 1000", {"n": 100, "end_mass": 1000}, (100, 200, 400, 800)),
    ):
        case = CASES[name](**parameters)
        for count in steps:
            run = simulate(case.scene, case.duration, case.duration / count)
            if run.status != "ok":
                yield f"| {label} | {case.duration / count:g} s | {run.status} | | |"
                continue
            energy = run.energy()
            lost = np.abs(energy - energy[0]).max() / exchanged(run, case.scene)
            yield (
                f"| {label} | {case.duration / count:g} s | {case.error(run):.0e} | {lost:.0e} "
                f"| {shown(run.joint_error().max())} |"
            )


def exchanged(run, scene):
    """The largest kinetic energy of a run that starts at rest, J: what has fallen."""
    mass = np.array([body.mass for body in scene.bodies])
    height = run.position[..., -1]
    return np.max((height[0] - height) @ mass) * G


def growth_table():
    """What a step costs as a chain grows, counted."""
    yield "| links | rows m | operations a step | per link | a dense A would have |"
    yield "|---|---|---|---|---|"
    for n in (10, 100, 1000, 10000):
        needs = model(CASES["chain"](n=n).scene)
        m, operations = needs.rows, needs.operations
        yield f"| {n} | {m} | {operations} | {operations / n:.0f} | {m**2} numbers |"


def door_table():
    """The forces of a door's hinges, which are not determined, and their sum, which is."""
    yield "| door with | rows | rank | at the upper hinge (N) | sum of all (N) | by statics and Newton (N) |"
    yield "|---|---|---|---|---|---|"
    for hinges in (1, 2, 3):
        case = CASES["door"](hinges=hinges)
        run = simulate(case.scene, 1.0, 0.01)
        forces = run.joint_forces().force[-1]
        exact = case.exact.force(run.time)[-1]
        sums = (np.linalg.norm(np.sum(forces, axis=0)), np.linalg.norm(exact))
        yield (
            f"| {hinges} hinge{'s' if hinges > 1 else ''} | {5 * hinges} | 5 "
            f"| {np.linalg.norm(forces[-1]):.2f} | {sums[0]:.3f} | {sums[1]:.3f} |"
        )


TABLES = {"forms": forms_table, "errors": errors_table, "growth": growth_table, "door": door_table}
