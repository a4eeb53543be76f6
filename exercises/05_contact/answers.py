"""Right answers to the exercise of unit 05, and what typical mistakes would answer. Grader's side only."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import exercises

given = exercises.part("05_contact", "given")
G = given.G


# --- a disc on a road ---------------------------------------------------------------------------------------


def foot(centre, a):
    """The point of the road nearest to the centre: the best root of (x − c_x) + 2 a x (a x² − c_y) = 0."""
    x, y = centre
    roots = np.roots([2 * a * a, 0, 1 - 2 * a * y, -x]) if a else np.array([x])
    real = roots[np.abs(roots.imag) < 1e-7].real
    best = real[np.argmin((real - x) ** 2 + (a * real**2 - y) ** 2)]
    for _ in range(3):  # the roots to rounding
        slope = 1 + 2 * a * (3 * a * best**2 - y)
        best -= ((best - x) + 2 * a * best * (a * best**2 - y)) / slope
    return np.array([best, a * best**2])


def gap(v, below=False, turned=1.0, radius=1.0):
    """(gap, point on the road, normal)."""
    centre, a = v["centre"], v["a"]
    point = np.array([centre[0], a * centre[0] ** 2]) if below else foot(centre, a)
    slope = 2 * a * point[0]
    normal = np.array([-slope, 1.0]) / np.hypot(1, slope)
    return float((centre - point) @ normal - radius * v["radius"]), point, turned * normal


def rows(v, arm=None, tangent=1.0, moment=1.0):
    """J (2, 3) of the rows n and t."""
    size, _, n = gap(v)
    ρ = v["radius"] + size / 2 if arm is None else arm(v["radius"], size)
    return np.array([[n[0], n[1], 0.0], [-tangent * n[1], tangent * n[0], -tangent * moment * ρ]])


def after(v, closing=True, pulls=False, clip=True, disc=0.5, limit=None):
    """u⁺ of one step: (v_x, v_y, ω)."""
    h, m, u = v["dt"], v["mass"], np.array(v["u"], dtype=float)
    size = gap(v)[0]
    J = rows(v)
    inverse = 1 / np.array([m, m, disc * m * v["radius"] ** 2])
    free = u + h * np.array([0, -G, 0])
    A = (J * inverse) @ J.T
    w = J @ free
    λ_n = -(w[0] + closing * size / h) / A[0, 0]
    λ_n = λ_n if pulls else max(0.0, λ_n)
    most = v["mu"] * (abs(λ_n) if limit is None else limit(v, h))
    λ_t = np.clip(-w[1] / A[1, 1], -most, most) if clip else -w[1] / A[1, 1]
    return free + inverse * (J.T @ np.array([λ_n, λ_t]))


def rolled(v, inertia=0.5):
    """Where the centre is after the time, by the motion of a disc that rolls without slipping (SciPy).

    The contact's x is the one coordinate. The centre's speed is the road's, ẋ √(1 + s²), times 1 − κ r, s the
    slope and κ the curvature; the energy is ½ (1 + inertia) speed² + g y of the centre.
    """
    a, r = v["a"], v["radius"]

    def centre(x):
        return np.array([x, a * x * x]) + r * np.array([-2 * a * x, 1]) / np.hypot(1, 2 * a * x)

    def mass(x):
        s = 1 + 4 * a * a * x * x
        return (1 + inertia) * s * (1 - r * 2 * a / s**1.5) ** 2

    def motion(_, state, ε=1e-5):
        x, rate = state
        force = -G * (centre(x + ε)[1] - centre(x - ε)[1]) / (2 * ε)
        bend = (mass(x + ε) - mass(x - ε)) / (2 * ε)
        return rate, (force - 0.5 * bend * rate**2) / mass(x)

    x0 = foot(v["centre"], a)[0]
    done = solve_ivp(motion, (0, v["dt"] * v["steps"]), (x0, 0.0), rtol=1e-9, atol=1e-11)
    return centre(done.y[0, -1])


# --- friction that depends on the direction -----------------------------------------------------------------


def sliding(v, power=2, sign=-1.0):
    """λ_t that dissipates most, of all with (λ_1/μ_1)² + (λ_2/μ_2)² ≤ λ_n²."""
    w, μ = v["w"], v["mu"]
    along = np.array([μ[0] ** power * w[0], μ[1] ** power * w[1]])
    size = np.hypot(μ[0] * w[0], μ[1] * w[1])
    return sign * v["normal"] * along / size if size > 0 else np.zeros(2)


def opposite(v):
    """On the ellipse, but straight against w."""
    w, μ = v["w"], v["mu"]
    size = np.hypot(w[0] / μ[0], w[1] / μ[1])
    return -v["normal"] * w / size if size > 0 else np.zeros(2)


def holding(v):
    """The point of the ellipse that is nearest to −pull, by one equation for a multiplier."""
    half, p = v["normal"] * v["mu"], -v["pull"]
    if np.sum((p / half) ** 2) <= 1:
        return p

    def over(τ):
        return np.sum((half * p / (half**2 + τ)) ** 2) - 1

    τ = brentq(over, 0, 2 * np.max(half) * np.linalg.norm(p) + 1, xtol=1e-15, rtol=1e-14)
    return half**2 * p / (half**2 + τ)


def shortened(v):
    """−pull made shorter until it is on the ellipse."""
    half, p = v["normal"] * v["mu"], -v["pull"]
    return p / max(1.0, np.sqrt(np.sum((p / half) ** 2)))


def boxed(v):
    """Each component clipped by itself."""
    half = v["normal"] * v["mu"]
    return np.clip(-v["pull"], -half, half)


def grained(v, there=1.0, back=1.0):
    """``holding``, with the grain turned by an angle against the frame."""

    def turn(angle):
        c, s = np.cos(angle), np.sin(angle)
        return np.array([[c, -s], [s, c]])

    inside = {**v, "pull": turn(-there * v["angle"]) @ v["pull"]}
    return turn(back * v["angle"]) @ holding(inside)
