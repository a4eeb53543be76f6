"""Helpers of the exercise of unit 09, error correction (slide S13)."""

import numpy as np

G = 9.81  # m/s², downwards, along −y
GRAVITY = np.array([0.0, -G])


def rk4(rate, y, dt):
    """One step of Runge and Kutta's method of order 4; rate(y) is ẏ, an array like y."""
    k1 = rate(y)
    k2 = rate(y + dt / 2 * k1)
    k3 = rate(y + dt / 2 * k2)
    k4 = rate(y + dt * k3)
    return y + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def show_swing(swing):
    """Draws how a rod that is 2 cm too long comes back, computed by swing, for three pairs of α and β."""
    curves = {}
    for alpha, beta in ((0, 10), (2, 10), (10, 10)):
        x, v, gaps = np.array([1.02, 0.0]), np.zeros(2), [0.02]
        for _ in range(150):
            answer = swing(x, v, 1.0, alpha, beta, 0.01, 1)
            if not isinstance(answer, tuple):
                print("The picture comes once swing passes its check.")
                return
            x, v = answer
            gaps.append(np.hypot(*x) - 1)
        curves[f"α = {alpha}/s, β = {beta}/s"] = gaps
    _draw_swing(curves)


def _draw_swing(curves):
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
    for (label, gaps), style in zip(curves.items(), (":", "--", "-"), strict=True):
        axes.plot(0.01 * np.arange(len(gaps)), gaps, style, label=label)
    axes.set(xlabel="time in s", ylabel="gap in m")
    axes.legend()
    plt.show()


def show_chain(chain):
    """Draws a chain of ten links, held at one end, half a second after it was let go, stiff and soft."""
    start = np.column_stack([0.1 * np.arange(11), np.zeros(11)])
    inverse, shapes = np.array([0.0] + [10.0] * 10), {}
    for compliance in (0.0, 1e-3, 1e-2):
        x, v = start, np.zeros_like(start)
        for _ in range(50):
            answer = chain(x, v, inverse, 0.1, compliance, 0.01, 50)
            if not isinstance(answer, tuple):
                print("The picture comes once chain passes its check.")
                return
            x, v = answer[:2]
        shapes[f"{compliance:g} m/N"] = x
    _draw_chain(shapes)


def _draw_chain(shapes):
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(figsize=(4.5, 4), layout="constrained")
    for (label, x), style in zip(shapes.items(), ("-o", "--s", ":^"), strict=True):
        axes.plot(*x.T, style, label=label)
    axes.set(xlabel="x in m", ylabel="y in m", aspect="equal")
    axes.legend(title="compliance")
    plt.show()
