"""Helpers of the exercise of unit 02, the equation of motion (slides S4, S9)."""

import numpy as np

GRAVITY = 9.81  # m/s²


def polygon(vertices):
    """`(area, centre, second_moment)` of a polygon with its corners in counter-clockwise order.

    `second_moment` is the integral of the squared distance from `centre` over the area, in m⁴: times kg/m² it
    is the polygon's moment of inertia about its own centre.
    """
    a = np.asarray(vertices, dtype=float)
    b = np.roll(a, -1, axis=0)
    cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    area = cross.sum() / 2
    centre = cross @ (a + b) / (6 * area)
    about_origin = cross @ np.sum(a * a + a * b + b * b, axis=1) / 12
    return area, centre, about_origin - area * centre @ centre


def decay(speed):
    """The rate ẏ = −speed · y."""
    return lambda t, y: -speed * y


def forced(frequency, drive):
    """The rate of y = (position, velocity): an oscillator that a force drive · cos(2t) shakes."""
    return lambda t, y: np.array([y[1], -(frequency**2) * y[0] + drive * np.cos(2 * t)])


def pendulum(length):
    """The rate of y = (angle, angular velocity) of a pendulum."""
    return lambda t, y: np.array([y[1], -GRAVITY / length * np.sin(y[0])])


def swelling(strength):
    """The rate ẏ = strength · y² cos t. Its exact answer is y(t) = 1 / (1/y(0) − strength · sin t)."""
    return lambda t, y: strength * y**2 * np.cos(t)


def euler():
    """One step of the explicit Euler method, as a function step(rate, t, y, dt)."""
    return lambda rate, t, y, dt: y + dt * rate(t, y)


def show_tumble(march, step, body_rate):
    """Draws the body-frame rates of a plate thrown about its middle axis, without and with a wheel."""
    inertia, omega = np.diag([1.0, 2.0, 3.0]), np.array([0.05, 2.0, 0.05])

    def run(wheel):
        return march(step, lambda t, y: body_rate(y, inertia, wheel, np.zeros(3)), omega, 0.02, 1000)

    runs = [run(np.zeros(3)), run(np.array([0.0, 3.0, 0.0]))]
    if any(np.shape(history) != (1001, 3) for history in runs):
        print("The picture comes once march, kutta_step and gyrostat_rate pass their checks.")
        return
    _draw_tumble(np.arange(1001) * 0.02, runs)


def _draw_tumble(time, runs):
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(1, 2, figsize=(9, 3), sharey=True, layout="constrained")
    for panel, history, title in zip(
        axes, runs, ("wheel at rest", "wheel turning about axis 2"), strict=True
    ):
        for column, (colour, line) in enumerate((("#0072B2", "-"), ("#D55E00", "--"), ("#009E73", ":"))):
            panel.plot(time, history[:, column], line, color=colour, label=f"Ω{column + 1}")
        panel.set(title=title, xlabel="time in s")
    axes[0].set_ylabel("rad/s in the body frame")
    axes[0].legend(loc="lower left")
    plt.show()


def show_flight(march, step, air_force):
    """Draws the path of a kicked ball of 0.43 kg: without spin, with spin, and with spin against the wind.

    It is kicked along +x and up. The spin is about +z (up), the wind blows along −x. Paths end on the ground.
    """
    mass, gravity, runs = 0.43, np.array([0.0, 0.0, -GRAVITY]), {}
    for label, spin, wind in (
        ("no spin", 0.0, 0.0),
        ("spin", 60.0, 0.0),
        ("spin, wind from ahead", 60.0, -6.0),
    ):

        def rate(t, y, spin=spin, wind=wind):
            force = air_force(y[3:], np.array([0.0, 0.0, spin]), np.array([wind, 0.0, 0.0]), 0.006, 0.0012)
            return np.concatenate([y[3:], gravity + (np.zeros(3) if force is None else force) / mass])

        runs[label] = march(step, rate, np.array([0.0, 0.0, 0.0, 25.0, 0.0, 10.0]), 0.02, 110)
    if any(np.shape(history) != (111, 6) for history in runs.values()):
        print("The picture comes once march and kutta_step pass their checks.")
        return
    _draw_flight({label: _down_to_the_ground(np.asarray(history)) for label, history in runs.items()})


def _down_to_the_ground(history):
    """The rows until the height is 0 again, the last one between the two steps around that."""
    below = np.flatnonzero(history[1:, 2] < 0)
    if len(below) == 0:
        return history
    last, first = history[below[0]], history[below[0] + 1]
    part = last[2] / (last[2] - first[2])
    return np.vstack([history[: below[0] + 1], last + part * (first - last)])


def _draw_flight(runs):
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(1, 2, figsize=(9, 3), layout="constrained")
    for panel, column, title in ((axes[0], 2, "from the side: height"), (axes[1], 1, "from above: sideways")):
        for (label, history), (colour, line) in zip(
            runs.items(), (("#0072B2", "-"), ("#D55E00", "--"), ("#009E73", ":")), strict=True
        ):
            panel.plot(history[:, 0], history[:, column], line, color=colour, label=label)
        panel.set(title=title, xlabel="x in m", ylabel=f"{'xyz'[column]} in m")
    axes[0].legend()
    plt.show()
