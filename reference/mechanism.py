"""A scene's joints laid out as rows for computing: those that hold, those that spring, those with bounds.

    rigid     w = 0, or a motor's speed: λ takes any value                       a line in the (w, λ) plane
    soft      λ = −stiffness φ − damping w: a spring and damper                  a slanted line
    bounded   limits (λ ≥ 0 only where φ is at its limit), motors of finite force: polylines, as contacts

Slides S5–S7, S12; lectures/03_jacobian.md.
"""

from typing import NamedTuple

import numpy as np

from .compiled import lean
from .joints import DISTANCE, LINEAR, TURN
from .multipliers import Factor
from .rows import Jacobian, Rows, fill_rows, make_jacobian


class Mechanism(NamedTuple):
    """The joints of a scene, and room to compute in: m rigid rows first, then soft ones; M moving bodies.

    B (m, 2, k): the rows of J M⁻¹. right (m,): right-hand side of A λ = right; λ (m,): its solution for the
    constraint forces; change (m,): for what is put back after a step. v (M, d), ω (r, 3) or (r, 1):
    velocities or their rates. solver, factor: see ``multipliers``. watch (4,): the smallest pivot, relative
    to what it was before the elimination; the smallest and the largest rank seen so far; a gap that could not
    be closed, relative to the scale.
    """

    rows: Rows
    jacobian: Jacobian
    B: np.ndarray
    right: np.ndarray
    λ: np.ndarray
    change: np.ndarray
    v: np.ndarray
    ω: np.ndarray
    solver: int
    factor: Factor
    watch: np.ndarray
    scale: float  # m: the size of the mechanism, for tolerances
    tolerance: float  # of φ, relative to the scale


def make_mechanism(bodies, rigid, soft, solver, factor, tolerance=1e-11):
    """Room for the rows of these bodies (``layout.Bodies``)."""
    d, r, m = bodies.dimension, len(bodies.rotating), len(rigid.kind)
    rows = Rows(*(np.concatenate(pair) for pair in zip(rigid, soft, strict=True)))
    jacobian = make_jacobian(len(rows.kind), r, d)
    return Mechanism(
        rows,
        jacobian,
        B=np.zeros((m, *jacobian.J.shape[1:])),
        right=np.zeros(m),
        λ=np.zeros(m),
        change=np.zeros(m),
        v=np.zeros((len(bodies.moving), d)),
        ω=np.zeros((r, 3 if d == 3 else 1)),
        solver=solver,
        factor=factor,
        watch=np.array([1.0, m, 0, 0]),
        scale=mechanism_size(rigid),
        tolerance=tolerance,
    )


def mechanism_size(rows):
    """The longest arm from a centre of mass to a joint, or the longest rod, m; 1 where there is none."""
    arms = np.linalg.norm(rows.p, axis=2)[rows.bodies >= 0]
    size = max(arms.max(initial=0), rows.target[rows.kind == DISTANCE].max(initial=0))
    return float(size) or 1.0


def rigid_rows(bodies):
    """The ``Rows`` that hold whatever force it takes: those of the joints, and of motors without a limit."""
    made = []
    for number, joint in enumerate(bodies.joints):
        made += [(number, joint, row, {}) for row in joint.rows(bodies.declared)]
        if joint.motor is not None and joint.motor[1] == np.inf:
            made.append((number, joint, joint.free_row(bodies.declared), {"speed": joint.motor[0]}))
    return _lay_out(bodies, made)


def soft_rows(bodies):
    """The ``Rows`` of springs and dampers along the joints' coordinates."""
    made = [
        (
            number,
            joint,
            joint.free_row(bodies.declared),
            {"stiffness": joint.stiffness, "damping": joint.damping},
        )
        for number, joint in enumerate(bodies.joints)
        if joint.soft
    ]
    return _lay_out(bodies, made)


def bounded_rows(bodies):
    """The ``Rows`` of limits and of motors with a limited force: each with its bounds of λ.

    At a lower limit φ ≥ 0 and λ ≥ 0, at an upper one φ ≤ 0 and λ ≤ 0, φ counted from the limit. They make an
    LCP.
    """
    made = []
    for number, joint in enumerate(bodies.joints):
        low, high = joint.limits or (-np.inf, np.inf)
        if low > -np.inf:
            made.append((number, joint, joint.free_row(bodies.declared), {"limit": low, "lower": 0.0}))
        if high < np.inf:
            made.append((number, joint, joint.free_row(bodies.declared), {"limit": high, "upper": 0.0}))
        if joint.motor is not None and joint.motor[1] < np.inf:
            speed, most = joint.motor
            bounds = {"speed": speed, "lower": -most, "upper": most}
            made.append((number, joint, joint.free_row(bodies.declared), bounds))
    return _lay_out(bodies, made)


def _lay_out(bodies, made):
    """Rows from (joint's number, joint, row, what differs from a row that holds)."""
    m = len(made)
    rows = Rows(
        kind=np.array([row.kind for _, _, row, _ in made], dtype=int),
        bodies=np.full((m, 2), -1),
        joint=np.array([number for number, _, _, _ in made], dtype=int),
        p=np.zeros((m, 2, 3)),
        e=np.zeros((m, 3)),
        e2=np.zeros((m, 3)),
        c=np.zeros((m, 3)),
        target=np.zeros(m),
        stiffness=np.zeros(m),
        damping=np.zeros(m),
        speed=np.zeros(m),
        lower=np.full(m, -np.inf),
        upper=np.full(m, np.inf),
    )
    for k, (_, joint, row, law) in enumerate(made):
        i, j = joint.ends
        rows.bodies[k] = [-1 if body is None else bodies.slot.get(body, -1) for body in (i, j)]
        for side, (body, p) in enumerate(((i, row.p_i), (j, row.p_j))):
            if p is not None:
                _put(rows.p[k, side], bodies.fixed_point(body, p))
        for to, body, direction in ((rows.e, i, row.e), (rows.e2, i, row.e2), (rows.c, j, row.c)):
            if direction is not None:
                _put(to[k], bodies.fixed_direction(body, direction))
        rows.target[k] = _start_angle(bodies, i, j) if row.kind == TURN else row.length
        rows.target[k] += law.get("limit", 0.0) - (row.length if "limit" in law else 0.0)
        for name in ("stiffness", "damping", "speed", "lower", "upper"):
            getattr(rows, name)[k] = law.get(name, getattr(rows, name)[k])
    return rows


def _put(to, a):
    to[: len(a)] = a


def _start_angle(bodies, i, j):
    """The angle of j seen from i at the start, in the plane; what stands still counts as 0, as in rows."""
    if bodies.dimension == 3:
        return 0.0
    return sum(
        sign * bodies.orientation[body]
        for sign, body in ((-1, i), (1, j))
        if body is not None and body in bodies.slot
    )


@lean
def fill_positions(rows, states, state, out, φ):
    """φ (T, m) for the records ``states`` (T, size of y), one after the other."""
    for t in range(len(states)):
        for k in range(len(state.y)):
            state.y[k] = states[t, k]
        fill_rows(rows, state, out)
        for k in range(len(out.φ)):
            φ[t, k] = out.φ[k]


def positions_of_rows(bodies, rows, position, orientation):
    """φ (T, m) of the rows, m or rad, for position (T, n, d) and orientation (T, n, 4) or (T, n)."""
    φ = np.zeros((len(position), len(rows.kind)))
    out = make_jacobian(len(rows.kind), len(bodies.rotating), bodies.dimension)
    fill_positions(rows, bodies.pack(position, orientation), bodies.state(), out, φ)
    return φ


def worst_gap(bodies, position, orientation):
    """The worst gap in any joint, m: (T,); angles count as what they open at ``mechanism_size``.

    A joint's rows in m make one distance. Motors have none.
    """
    rows = rigid_rows(bodies)
    φ = positions_of_rows(bodies, rows, position, orientation) * (rows.speed == 0)
    long = (rows.kind == LINEAR) | (rows.kind == DISTANCE)
    gaps = np.zeros((len(bodies.joints) + 1, len(position)))  # one for where there is no joint
    np.add.at(gaps, rows.joint[long], np.square(φ[:, long]).T)
    turned = np.abs(φ[:, ~long]).max(axis=1, initial=0) * mechanism_size(rows)
    return np.maximum(np.sqrt(gaps.max(axis=0)), turned)


def spring_energy(bodies, position, orientation):
    """Energy of the springs along the joints' coordinates, J: (T,)."""
    rows = soft_rows(bodies)
    if len(rows.kind) == 0:
        return np.zeros(len(position))
    φ = positions_of_rows(bodies, rows, position, orientation)
    return 0.5 * np.square(φ) @ rows.stiffness
