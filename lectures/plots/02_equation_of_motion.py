"""Figures and tables of unit 02, the equation of motion: lectures/02_equation_of_motion.md."""

import matplotlib.pyplot as plt
import numpy as np

from lectures.plots import shown
from reference import Box, Point, Scene, simulate, view
from reference.cases import CASES
from reference.integrators import INTEGRATORS
from reference.measure import drift, fitted_order, period
from reference.rotation import over_arrays, rotate_back


def mass_on_spring(velocity=0.0):
    """1 kg on a spring of 1 N/m along x, pulled out by 1 m: ω = 1 rad/s. The spring is 10 m long."""
    scene = Scene(gravity=(0, 0))
    mass = scene.add(Point(), mass=1, position=(1, 0), velocity=(velocity, 0))
    scene.spring(mass, None, stiffness=1, length=10, point_b=(10, 0))
    return scene


def plate(rates=(0.01, 1, 0)):
    """The torque-free top: a plate with I = (1, 2, 3) kg m², spun almost about its middle axis."""
    scene = Scene(gravity=(0, 0, 0))
    scene.add(Box((1, 0.7, 0.15)), mass=6, inertia=(1, 2, 3), angular_velocity=rates)
    return scene


def body_rates(run):
    """The angular velocity in the body's frame (T, 3)."""
    return over_arrays(rotate_back)(run.orientation[:, 0], run.angular_velocity[:, 0])


def three_eulers():
    """Phase plane of the mass on a spring."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.5, 3.4))
    names = {
        "explicit Euler": "explicit_euler",
        "velocity first": "symplectic_euler",
        "position first": "symplectic_euler_position_first",
    }
    for label, name in names.items():
        run = simulate(mass_on_spring(), 20, 0.2, integrator=name)
        left.plot(run.position[:, 0, 0], run.velocity[:, 0, 0], label=label)
        right.plot(run.time, run.energy() / run.energy()[0], label=label)
    turn = np.linspace(0, 2 * np.pi, 200)
    left.plot(np.cos(turn), np.sin(turn), color="grey", linestyle="-", linewidth=1, label="exact")
    left.set(xlabel="x (m)", ylabel="v (m/s)", aspect="equal", xlim=(-1.7, 1.7), ylim=(-1.7, 1.7))
    left.legend(loc="center", fontsize=8)
    right.set(xlabel="time (s)", ylabel="energy / energy at the start", ylim=(0.5, 2.2))
    return figure


def flip():
    """The plate turning over: its rates, and the plate at five instants."""
    figure, axes = plt.subplots(figsize=(7.5, 2.8))
    run = simulate(plate(), 84, 0.02, integrator="splitting6")
    view.plot_series(
        run.time, dict(zip(("Ω₁", "Ω₂", "Ω₃"), body_rates(run).T, strict=True)), "rate (rad/s)", axes
    )
    top = CASES["torque_free_top"]().exact.period
    for k, name in ((0.5, "flipped"), (1, "one period")):
        axes.axvline(k * top, color="grey", linewidth=0.8)
        axes.annotate(name, (k * top, 0.4), color="0.35", rotation=90, ha="right", fontsize=8)
    return figure


def flip_frames():
    """The plate before, while and after it turns over."""
    run = simulate(plate(), 20.8, 0.02, integrator="splitting6", record_every=10)
    return view.key_frames(plate(), run, frames=6, view=(25, 20))


def orders():
    """Attitude error of the torque-free top against the step, for every integrator."""
    steps = 0.4 / 2 ** np.arange(9)
    case = CASES["torque_free_top"](inertia=(1, 2, 3), rates=(0.1, 3, 0.1), duration=2.0)
    return steps, {
        name: [case.error(simulate(case.scene, 2.0, h, integrator=name)) for h in steps]
        for name in INTEGRATORS
    }


def convergence():
    """The orders, drawn."""
    steps, errors = orders()
    errors.pop("symplectic_euler_position_first")  # its line would cover the other symplectic Euler's
    figure, axes = plt.subplots(figsize=(7.5, 4.4))
    guides = {"splitting": 2, "splitting4": 4, "splitting6": 6}
    view.plot_convergence(steps, errors, guides, axes, ylabel="attitude error after 2 s (rad)")
    return figure


LONG_RUN = ("rk4", "splitting", "implicit_midpoint", "implicit_gyroscopic")


def invariants():
    """Energy and angular momentum of the plate over a long time."""
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.2), sharex=True)
    for name in LONG_RUN:
        run = simulate(plate(), 400, 0.2, integrator=name, record_every=5)
        L = run.angular_momentum()
        panels[0].semilogy(run.time, np.abs(run.energy() / run.energy()[0] - 1) + 1e-16, label=name)
        panels[1].semilogy(
            run.time, np.linalg.norm(L - L[0], axis=1) / np.linalg.norm(L[0]) + 1e-16, label=name
        )
    panels[0].set(xlabel="time (s)", ylabel="relative energy error", ylim=(1e-17, 10))
    panels[1].set(xlabel="time (s)", ylabel="relative error of L", ylim=(1e-17, 10))
    panels[1].legend(loc="upper left", bbox_to_anchor=(1, 1), fontsize=8)
    return figure


def update_order():
    """Free fall by the two symplectic Eulers: one ahead of the parabola, one behind."""
    figure, axes = plt.subplots(figsize=(7.5, 2.8))
    scene = Scene(gravity=(0, -9.81))
    scene.add(Point(), mass=1)
    for name, label in (
        ("symplectic_euler", "velocity first (pybullet)"),
        ("symplectic_euler_position_first", "position first (pymunk)"),
    ):
        run = simulate(scene, 1, 0.05, integrator=name)
        axes.plot(
            run.time, run.position[:, 0, 1] + 4.905 * run.time**2, marker="o", markersize=3, label=label
        )
    axes.set(xlabel="time (s)", ylabel="height − exact height (m)")
    axes.legend()
    return figure


FIGURES = {
    "three_eulers": three_eulers,
    "flip": flip,
    "flip_frames": flip_frames,
    "convergence": convergence,
    "invariants": invariants,
    "update_order": update_order,
}


def integrators_table():
    """Of each integrator: order claimed and measured, and the worst of energy and momentum in a long run."""
    steps, errors = orders()
    yield "| integrator | order | measured | force evaluations | symmetric | energy error | error of L |"
    yield "|---|---|---|---|---|---|---|"
    for name, method in INTEGRATORS.items():
        run = simulate(plate(), 400, 0.05, integrator=name, record_every=10)
        clear = np.array(errors[name]) > 1e-9  # well above rounding
        measured = fitted_order(steps[clear], np.array(errors[name])[clear])
        energy, momentum = shown(drift(run.energy())), shown(drift(run.angular_momentum()))
        yield (
            f"| `{name}` | {method.order} | {measured:.1f} | {method.evaluations} | "
            f"{'yes' if method.symmetric else 'no'} | {energy} | {momentum} |"
        )


def periods_table():
    """The period of the torque-free top, by step."""
    exact = CASES["torque_free_top"]().exact.period
    yield "| integrator | h = 0.1 s | h = 0.05 s | h = 0.025 s |"
    yield "|---|---|---|---|"
    for name in ("implicit_midpoint", "splitting", "rk4", "splitting4", "splitting6"):
        runs = [simulate(plate(), 90, h, integrator=name) for h in (0.1, 0.05, 0.025)]
        cells = (shown(abs(period(run.time, body_rates(run)[:, 1]) / exact - 1)) for run in runs)
        yield f"| `{name}` | {' | '.join(cells)} |"


TABLES = {"integrators": integrators_table, "periods": periods_table}
