"""Two point masses that attract each other: Kepler's ellipse.

The relative position is r = a (cos E − e) P + a √(1−e²) sin E Q, with the eccentric anomaly E from Kepler's
equation E − e sin E = t √(GM/a³); P points to the periapsis, where the motion starts, Q along the velocity
there.

Slides S4, S9; lectures/02_equation_of_motion.md. Source: Landau & Lifshitz, Mechanics (1976), section 15.
"""

import numpy as np

from ..scene import Scene
from ..shapes import Point
from .case import Case, Motion, at_rest, checked_dimension, position_error, positive


def eccentric_anomaly(mean, eccentricity):
    """E (…,) of Kepler's equation E − e sin E = M, by Newton's method; 0 ≤ e < 1, any M (…,) in rad."""
    turns = np.round(mean / (2 * np.pi)) * 2 * np.pi
    M = mean - turns
    E = M + eccentricity * np.sign(M)  # from here the iteration is monotone, for every e < 1
    for _ in range(100):
        step = (E - eccentricity * np.sin(E) - M) / (1 - eccentricity * np.cos(E))
        E = E - step
        if np.all(np.abs(step) < 1e-15):
            break
    return E + turns


def two_body_orbit(dimension=3, eccentricity=0.5, periods=3.25):
    """Masses of 3 and 1 kg on ellipses about their centre of mass, which drifts. Error: distance over
    semi-axis a.

    G = 1, a = 1 m; periods: the duration in periods, a quarter past a whole one, since at whole periods the
    error looks smaller than it is (only the phase counts there).
    """
    positive(periods=periods)
    if not 0 <= eccentricity < 1:
        raise ValueError(
            f"eccentricity must be at least 0 and below 1 for an ellipse, but is {eccentricity!r}"
        )
    masses, a, G = np.array([3.0, 1.0]), 1.0, 1.0
    rate = np.sqrt(G * masses.sum() / a**3)
    P, Q = np.eye(2) if checked_dimension(dimension) == 2 else np.array([[2, 1, 2], [-2, 2, 1]]) / 3
    drift = np.array([0.02, -0.01, 0.03])[:dimension]
    share = np.array([[-masses[1]], [masses[0]]]) / masses.sum()  # of the distance, for each mass
    short = np.sqrt(1 - eccentricity**2)

    def exact(time):
        t = np.asarray(time, dtype=float)[..., None, None]
        E = eccentric_anomaly(rate * t, eccentricity)
        r = a * ((np.cos(E) - eccentricity) * P + short * np.sin(E) * Q)
        v = a * rate / (1 - eccentricity * np.cos(E)) * (short * np.cos(E) * Q - np.sin(E) * P)
        turned = at_rest((*np.shape(t)[:-2], 2), dimension)
        return Motion(drift * t + share * r, turned[0], drift + share * v, turned[1])

    start = exact(0.0)
    scene = Scene(gravity=np.zeros(dimension))
    for mass, position, velocity in zip(masses, start.position, start.velocity, strict=True):
        scene.add(Point(), mass=mass, position=position, velocity=velocity)
    scene.gravitate(G)
    return Case(
        "two_body_orbit",
        scene,
        periods * 2 * np.pi / rate,
        exact,
        position_error(a),
        "relative to the semi-axis",
        "Kepler; Landau & Lifshitz, Mechanics, section 15",
        "At the periapsis the pull is ((1+e)/(1−e))² times that at the apoapsis; a fixed dt must serve both.",
    )
