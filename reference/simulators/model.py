"""What will be built for a scene, and what each part costs: only what the scene needs.

Slides S3, S4, S12; lectures/02_equation_of_motion.md.
"""

from dataclasses import dataclass

import numpy as np

from ..choice import choose_solver
from ..integrators import INTEGRATORS
from ..layout import Bodies
from ..mechanism import rigid_rows, soft_rows
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
    integrator: str
    why: str
    solver: str | None = None
    why_solver: str = ""
    rows: int = 0

    @property
    def operations(self):
        """Floating-point operations of a step, roughly: those of all terms, as often as the
        integrator evaluates them.
        """
        return INTEGRATORS[self.integrator].evaluations * sum(term.operations for term in self.terms)

    def __str__(self):
        where = "in the plane" if self.dimension == 2 else "in space"
        lines = [
            f"{self.moving} moving bodies {where}, {self.rotating} of them rotate, {self.static} static: "
            f"{self.velocities} velocities in u",
            f"simulator {self.simulator}, integrator {self.integrator}: {self.why}",
            *(
                [f"solver {self.solver} for the {self.rows} rows of the joints: {self.why_solver}"]
                if self.solver
                else []
            ),
            f"{'term':<24}{'count':>8}{'operations':>12}",
            *(f"{term.name:<24}{term.count:>8}{term.operations:>12}" for term in self.terms),
            f"about {self.operations} operations a step",
            f"not built: {', '.join(self.absent)}",
        ]
        return "\n".join(lines)


def model(scene):
    """Tell what will be built for this scene and what each term costs. Returns a ``Model``.

    Raises TypeError for what is not a Scene, and Unsupported where no simulator of this course can run it.
    """
    if not isinstance(scene, Scene):
        raise TypeError(f"scene must be a Scene, but is {scene!r}")
    touching = next(scene.colliding_pairs(), None)
    if touching:
        i, j = touching
        raise Unsupported(
            f"bodies {i} and {j} could touch, and no simulator here computes contact yet: put bodies that "
            f"should pass through each other in one group, or call scene.pair({i}, {j}, collide=False)"
        )
    for number, joint in enumerate(scene.joints):
        if joint.limits is not None or (joint.motor is not None and joint.motor[1] < np.inf):
            raise Unsupported(
                f"joint {number}, a {type(joint).__name__}, has limits or a motor of limited force, which "
                "make an LCP, and no simulator here solves one yet; leave out limits, or give the motor "
                "max_force=inf"
            )
    moving = [body for body in scene.bodies if not body.static]
    rotating = [body for body in moving if not isinstance(body.shape, Point)]
    d, m, r = scene.dimension, len(moving), len(rotating)
    present, absent = _terms(scene, m, r)
    integrator, why = _integrator(scene, rotating)
    solver, why_solver, rows = None, "", 0
    if scene.joints:
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
        "smooth",
        integrator,
        why,
        solver,
        why_solver,
        rows,
    )


def _terms(scene, m, r):
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
    )
    absent = [term.name for term in candidates if not term.count]
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
