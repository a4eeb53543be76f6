"""The equation of motion with joints, as matrices to look at: A and b in three forms, and two ways to solve.

    M u̇ = f_e + Jᵀ λ,   J u̇ + J̇ u = 0      ⇒      A λ + b = 0,   A = J M⁻¹ Jᵀ,   b = J M⁻¹ f_e + J̇ u

says it for accelerations. A time-stepping method says it for the velocities u⁺ at the end of a step, with J
as it is at the start, so that J̇ u does not appear:

    M u⁺ = M u + Δt f_e + Δt Jᵀ λ,   J u⁺ = speed − share φ/Δt
        ⇒   w⁺ = A λ + b,   A = Δt J M⁻¹ Jᵀ,   b = J (u + Δt M⁻¹ f_e) + share φ/Δt − speed,   w⁺ = 0

Both are M x − h Jᵀ λ = right, J x = wanted: x is u̇ and h is 1, or x is u⁺ and h is Δt. λ is a force in both,
N or N m; Δt λ is the impulse. What runs in a simulation is in ``embedding``, row by row; here are matrices.

Slides S7–S9; lectures/04_embedding.md.
"""

from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

from . import inputs
from .bodies import add_gyroscopic_torque
from .embedding import add_joint_springs, fill_mass_rows
from .factored import Factored
from .forces import external_force, with_user_forces
from .layout import Bodies
from .mechanism import rigid_rows, soft_rows
from .rows import dense, fill_rows, make_jacobian

FORMS = ("dense", "sparse", "factored")
SINGULAR = 1e-11  # of A's largest eigenvalue: what is smaller is rounding


class Equation(NamedTuple):
    """M x − h Jᵀ λ = right and J x = wanted, and what follows: A λ + b = 0. N velocities, m rows.

    The N columns are all v, of the bodies that rotate first, then all ω. M (N, N) and J (m, N): dense, or
    SciPy's sparse arrays; A: the same, or a ``Factored`` with h in it. φ (m,): how far the rows are from
    holding, m or rad. J x and wanted are ẇ or w, m/s² or m/s, rad/s² or rad/s.
    """

    M: object
    J: object
    right: np.ndarray
    wanted: np.ndarray
    A: object
    b: np.ndarray
    h: float
    φ: np.ndarray


def equation(scene, state=None, *, form="dense", step=None, share=0.0, time=0.0):
    """The ``Equation`` of a scene with joints.

    state: all bodies, from ``sim.state`` or ``run.state()``; None: as the scene starts. form: "dense",
    "sparse" or "factored", made in three ways that agree. step: Δt, s, for velocities; None: accelerations.
    share: of φ to be taken back in a step (0 … 1, velocities only). time: s, for forces that depend on it.
    Limits and motors of limited force are not in it. Raises ValueError or TypeError, naming the argument.
    """
    inputs.choice("form", form, FORMS)
    share = inputs.number("share", share, least=0)
    if step is None and share:
        raise ValueError(
            f"share must be 0 where step is None, since accelerations have no step, but is {share!r}"
        )
    h = 1.0 if step is None else inputs.number("step", step, above=0)
    bodies = Bodies(scene)
    now = bodies.state() if state is None else _laid_out(bodies, state)
    rows = rigid_rows(bodies)
    jacobian = _jacobian(bodies, rows, now)
    u, force = now.u.copy(), _external(scene, bodies, now, time)
    M = _mass_matrix(bodies, jacobian.frame)
    J = scipy.sparse.csr_array(dense(jacobian.J, rows.bodies, len(bodies.moving), len(bodies.rotating)))
    if step is None:
        right, wanted = force, -jacobian.rate
    else:
        right, wanted = M @ u + h * force, rows.speed - share * jacobian.φ / h
    if form == "dense":
        M, J = M.toarray(), J.toarray()
        A = h * J @ np.linalg.solve(M, J.T)
        b = J @ np.linalg.solve(M, right) - wanted
    elif form == "sparse":
        inverse = _inverse(bodies, M)
        A = h * (J @ inverse @ J.T)
        b = J @ (inverse @ right) - wanted
    else:
        B = np.zeros_like(jacobian.J)
        fill_mass_rows(rows.bodies, jacobian.J, bodies.system.mass, bodies.system.inertia, jacobian.frame, B)
        A = Factored(rows.bodies, jacobian.J, h * B, len(bodies.moving))
        b = dense(B, rows.bodies, len(bodies.moving), len(bodies.rotating)) @ right - wanted
    return Equation(M, J, right, wanted, A, b, h, jacobian.φ)


def solve_schur(equation):
    """x and λ by way of A λ = −b, then x = M⁻¹ (right + h Jᵀ λ).

    Of many λ the shortest, where A is dense or factored. Raises ValueError where a sparse A is singular.
    """
    A, b = equation.A, equation.b
    if isinstance(A, Factored):
        operator = scipy.sparse.linalg.LinearOperator(A.shape, matvec=lambda λ: A @ λ, dtype=float)
        λ, failed = scipy.sparse.linalg.minres(operator, -b, rtol=1e-14, maxiter=20 * len(b) + 100)
        if failed:
            raise ValueError(
                f"A λ = −b has not been solved by MINRES in {failed} iterations: try form='dense'"
            )
    elif scipy.sparse.issparse(A):
        λ = _solve_sparse(A, -b, "A")
    else:
        λ = np.linalg.lstsq(A, -b, rcond=SINGULAR)[0]
    force = equation.right + equation.h * (equation.J.T @ λ)
    if scipy.sparse.issparse(equation.M):
        return _solve_sparse(equation.M, force, "M"), λ
    return np.linalg.solve(equation.M, force), λ


def solve_kkt(equation):
    """x and λ at once, from the system that A is the Schur complement of: [[M, −h Jᵀ], [J, 0]].

    It has N + m unknowns, is not definite, and sparse however many rows a body has. Raises ValueError where
    it is singular, which redundant joints make it.
    """
    M, J, m = scipy.sparse.csr_array(equation.M), scipy.sparse.csr_array(equation.J), len(equation.b)
    system = scipy.sparse.block_array([[M, -equation.h * J.T], [J, scipy.sparse.csr_array((m, m))]])
    both = _solve_sparse(system, np.concatenate([equation.right, equation.wanted]), "the whole system")
    return np.split(both, [len(equation.right)])


def _solve_sparse(matrix, right, name):
    try:
        factor = scipy.sparse.linalg.splu(scipy.sparse.csc_array(matrix))
    except RuntimeError:
        factor = None
    pivots = np.abs(factor.U.diagonal()) if factor else np.zeros(1)
    if pivots.size and pivots.min() <= 1e-13 * pivots.max():
        raise ValueError(
            f"{name} is singular: joints are redundant, so that λ is not unique; try form='dense'"
        )
    return factor.solve(right)


def _laid_out(bodies, state):
    return bodies.state(state.position, state.orientation, state.velocity, state.angular_velocity)


def _jacobian(bodies, rows, state):
    jacobian = make_jacobian(len(rows.kind), len(bodies.rotating), bodies.dimension)
    fill_rows(rows, state, jacobian)
    return jacobian


def _external(scene, bodies, state, time):
    """f_e (N,): external forces, springs of joints and the gyroscopic torque."""
    position, orientation, velocity, spin = (part[0] for part in bodies.unpack(state.y[None]))
    seen = SimpleNamespace(
        position=position, orientation=orientation, velocity=velocity, angular_velocity=spin, time=time
    )
    force = external_force
    if scene.user_forces:
        force = with_user_forces(bodies, scene.user_forces, lambda t, state: seen)
    f, τ = np.zeros_like(state.v), np.zeros_like(state.ω)
    force(bodies.system, time, state, f, τ)
    soft = soft_rows(bodies)
    made = _jacobian(bodies, soft, state)
    add_joint_springs(soft.stiffness, soft.damping, made.φ, made.J, soft.bodies, 0, state, f, τ)
    add_gyroscopic_torque(bodies.system, state, τ)
    return np.concatenate([f.ravel(), τ.ravel()])


def _mass_matrix(bodies, frame):
    """M (N, N), sparse: the masses, then R I Rᵀ of each body."""
    masses = np.repeat(bodies.system.mass, bodies.dimension)
    if bodies.dimension == 2:
        return scipy.sparse.csr_array(
            scipy.sparse.diags_array(np.concatenate([masses, bodies.moments.ravel()]))
        )
    R = frame.reshape(-1, 3, 3)
    inertias = [r * moments @ r.T for r, moments in zip(R, bodies.moments, strict=True)]
    return scipy.sparse.csr_array(scipy.sparse.block_diag([scipy.sparse.diags_array(masses), *inertias]))


def _inverse(bodies, M):
    """M⁻¹, block by block."""
    linear = bodies.system.mass.size * bodies.dimension
    size = 3 if bodies.dimension == 3 else 1
    blocks = [np.linalg.inv(M[k : k + size, k : k + size].toarray()) for k in range(linear, M.shape[0], size)]
    first = scipy.sparse.diags_array(1 / M.diagonal()[:linear])
    return scipy.sparse.csr_array(scipy.sparse.block_diag([first, *blocks]))
