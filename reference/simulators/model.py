"""What will be built for a scene, and what each part costs: only what the scene needs.

Slides S3, S4, S12; lectures/02_equation_of_motion.md.
"""

from dataclasses import dataclass

import numpy as np

from ..choice import choose_solver
from ..collision import count_pairs
from ..integrators import INTEGRATORS
from ..layout import Bodies
from ..mechanism import bounded_rows, rigid_rows, soft_rows
from ..multipliers import MULTIPLIERS
from ..scene import Scene, Unsupported
from ..shapes import Point


@dataclass(frozen=True)
class Term:
    """One part of the model: how many there are, and the operations for all of them in one evaluation."""

    name: str
    count: int
    operations: int


@dataclass(frozen=True)
class Model:
    """What ``simulate`` will build. ``print(model(scene))`` shows it as a table.

    velocities: the length of u; terms: what is computed in each evaluation of the force; absent: what the
    scene does not need, and so is not built; simulator, integrator: what is chosen where the user doesn't
    say, and why; solver: the same for the joints' λ, None without joints; rows: of J that always hold.
    """

    dimension: int
    moving: int
    rotating: int
    static: int
    velocities: int
    terms: tuple
    absent: tuple
    simulator: str
    integrator: str | None
    why: str
    solver: str | None = None
    why_solver: str = ""
    rows: int = 0

    @property
    def operations(self):
        """Floating-point operations of a step, roughly: those of all terms, as often as the
        integrator evaluates them.
        """
        evaluations = INTEGRATORS[self.integrator].evaluations if self.integrator else 1
        return evaluations * sum(term.operations for term in self.terms)

    def __str__(self):
        where = "in the plane" if self.dimension == 2 else "in space"
        lines = [
            f"{self.moving} moving bodies {where}, {self.rotating} of them rotate, {self.static} static: "
            f"{self.velocities} velocities in u",
            f"simulator {self.simulator}"
            + (f", integrator {self.integrator}" if self.integrator else "")
            + f": {self.why}",
            *self._told_solver(),
            f"{'term':<24}{'count':>8}{'operations':>12}",
            *(f"{term.name:<24}{term.count:>8}{term.operations:>12}" for term in self.terms),
            f"about {self.operations} operations a step"
            + (
                ", and what the contacts cost, which depends on how many there are"
                if not self.integrator
                else ""
            ),
            f"not built: {', '.join(self.absent)}",
        ]
        return "\n".join(lines)

    def _told_solver(self):
        """A line on the solver, if there is one."""
        if not self.solver:
            return []
        parts = [f"the {self.rows} rows of the joints"] if self.rows else []
        what = " and ".join(parts + ["the contacts"] if self.solver == "cone_newton" else parts)
        return [f"solver {self.solver} for {what}: {self.why_solver}"]


def model(scene):
    """Tell what will be built for this scene and what each term costs. Returns a ``Model``.

    Raises TypeError for what is not a Scene, and Unsupported where no simulator of this course can run it.
    """
    if not isinstance(scene, Scene):
        raise TypeError(f"scene must be a Scene, but is {scene!r}")
    pairs = count_pairs(scene)
    bounded = [
        joint
        for joint in scene.joints
        if joint.limits is not None or (joint.motor is not None and joint.motor[1] < np.inf)
    ]
    soft = next((number for number, joint in enumerate(scene.joints) if joint.soft), None)
    if (pairs or bounded) and soft is not None:
        raise Unsupported(
            f"joint {soft}, a {type(scene.joints[soft]).__name__}, has a spring or damper, which no "
            "simulator here computes beside contact, limits or motors of limited force yet; use scene.spring"
        )
    moving = [body for body in scene.bodies if not body.static]
    rotating = [body for body in moving if not isinstance(body.shape, Point)]
    d, m, r = scene.dimension, len(moving), len(rotating)
    present, absent = _terms(scene, m, r, pairs)
    integrator, why = _integrator(scene, rotating)
    simulator, solver, why_solver = "smooth", None, ""
    if pairs or bounded:
        why = "bodies can touch" if pairs else "limits, and motors of limited force, make an LCP"
        simulator, integrator = "velocity_lcp", None
        solver, why_solver = "cone_newton", "Coulomb's law with the exact friction cone"
    rows = 0
    if scene.joints and simulator == "velocity_lcp":
        bodies = Bodies(scene)
        rows = len(rigid_rows(bodies).kind) + len(bounded_rows(bodies).kind)
        present += (Term("joints: J", rows, rows * (150 if d == 3 else 35)),)
    elif scene.joints:
        bodies = Bodies(scene)
        rigid = rigid_rows(bodies)
        solver, why_solver, rows, _, _ = choose_solver(bodies, rigid)
        present += _joint_terms(bodies, rigid, solver)
    return Model(
        d,
        m,
        r,
        len(scene.bodies) - m,
        m * d + r * (3 if d == 3 else 1),
        present,
        absent,
        simulator,
        integrator,
        why,
        solver,
        why_solver,
        rows,
    )


def _terms(scene, m, r, pairs):
    """The terms that are there, and the names of those that are not. Operations: counted in the kernels."""
    d = scene.dimension
    space = d == 3
    pulls = m * (m - 1) // 2 + m * sum(body.static and body.mass > 0 for body in scene.bodies)
    attracts = scene.gravitation > 0
    candidates = (
        Term("M⁻¹", m, m * d + r * (60 if space else 1)),
        Term("gyroscopic ω × Iω", r if space else 0, r * 75),
        Term("gravity", m if np.any(scene.gravity) else 0, m * d),
        Term("springs", len(scene.springs), len(scene.springs) * (170 if space else 90)),
        Term("drag", len(scene.drags), len(scene.drags) * (2 * d + 6)),
        Term("gravitation", pulls if attracts else 0, pulls * (8 * d + 6)),
        Term("user's forces (Python)", len(scene.user_forces), 0),
        Term("pairs that could touch", pairs, 0),
    )
    absent = [term.name for term in candidates if not term.count]
    absent = [name for name in absent if name != "pairs that could touch"]
    if not pairs:
        absent += ["collision detection, contact rows and LCP: nothing can touch"]
    return tuple(term for term in candidates if term.count), tuple(absent)


def _joint_terms(bodies, rigid, solver):
    """The terms of the joints. Operations of the solver: products, counted in what it made ready."""
    m, space = len(rigid.kind), bodies.dimension == 3
    soft = len(soft_rows(bodies).kind)
    factor = MULTIPLIERS[solver].prepare(rigid, bodies.system)
    links, k = len(factor.links), 6 if space else 3
    products = {
        "cholesky": m**3 // 3 + 2 * m * m,
        "minimum_norm": 2 * m**3 + 4 * m * m,
        "sparse": 2 * links + 4 * len(factor.values),
        "tree": links * 6 * k**3,
    }
    terms = (
        Term("joints: J and J̇ u", m, m * (180 if space else 45)),
        Term("joints: A = J M⁻¹ Jᵀ", len(factor.meeting), 2 * k * len(factor.meeting)),
        Term(f"joints: λ by {solver}", m, products[solver]),
        Term("joints: springs", soft, soft * (200 if space else 60)),
    )
    return tuple(term for term in terms if term.count)


def _integrator(scene, rotating):
    """The integrator that suits the scene's forces, and why."""
    if scene.joints:
        return "rk4", "constraint forces depend on velocity, so order 4 by Runge–Kutta"
    damped = scene.drags or scene.user_forces or any(spring.damping for spring in scene.springs)
    position_dependent = scene.springs or scene.gravitation
    gyroscopic = scene.dimension == 3 and any(
        np.ptp(np.linalg.eigvalsh(body.inertia)) > 0 for body in rotating
    )
    if damped:
        return "rk4", "forces may depend on velocity, so order 4 by Runge–Kutta"
    if position_dependent or gyroscopic:
        return (
            "splitting4",
            "no force depends on velocity, so order 4 by splitting, which keeps energy over long runs",
        )
    return "splitting", "all forces are constant, so a splitting step is exact"
