"""Helpers of the exercise of unit 04, embedding (slides S8–S9)."""

import numpy as np

GRAVITY = 9.81  # m/s², downwards, along −y


def weight(mass):
    """The weight of points in the plane, N: an array like mass, the diagonal of M, (m_1, m_1, m_2, m_2)."""
    return np.where(np.arange(len(mass)) % 2 == 1, -GRAVITY, 0.0) * mass


def rk4(rate, y, dt):
    """One step of Runge and Kutta's method of order 4; rate(y) is ẏ, an array like y."""
    k1 = rate(y)
    k2 = rate(y + dt / 2 * k1)
    k3 = rate(y + dt / 2 * k2)
    k4 = rate(y + dt * k3)
    return y + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def energy(x, u, mass):
    """Kinetic and potential energy, J."""
    return 0.5 * np.sum(mass * u**2) - weight(mass) @ x


def show_swing(swing):
    """Draws a swinging Atwood machine of three to one, computed by swing, and its energy."""
    mass, pulleys = np.array([1.0, 1, 3, 3]), np.array([0.0, 0, 1.5, 0])
    x, u = np.array([-0.8, -0.6, 1.5, -1.0]), np.zeros(4)
    path, energies = [x], [energy(x, u, mass)]
    for _ in range(400):
        answer = swing(x, u, mass, pulleys, 0.005, 1)
        if not isinstance(answer, tuple):
            print("The picture comes once swing passes its check.")
            return
        x, u = answer
        path.append(x)
        energies.append(energy(x, u, mass))
    _draw_swing(np.array(path), np.array(energies) - energies[0], pulleys)


def _draw_swing(path, gained, pulleys):
    import matplotlib.pyplot as plt

    _, (left, right) = plt.subplots(1, 2, figsize=(8, 3.4), layout="constrained")
    left.plot(path[:, 0], path[:, 1], color="#0072B2", label="1 kg")
    left.plot(path[:, 2], path[:, 3], "--", color="#D55E00", label="3 kg")
    left.plot(pulleys[::2], pulleys[1::2], "k^", label="pulleys")
    left.set(xlabel="x in m", ylabel="y in m", aspect="equal")
    left.legend()
    right.plot(0.005 * np.arange(len(gained)), gained, color="#009E73")
    right.set(xlabel="time in s", ylabel="energy gained in J")
    plt.show()
