"""Smooth motion: from the force to the velocities, from the velocities to positions and orientations.

Each integrator is one kernel, ``step(force, system, t, h, state, work)``: it moves ``state`` from t to t + h.
``force(system, t, state, f, τ)`` fills in the external force. ``INTEGRATORS`` says of each what order it has,
whether it is symmetric (a step back undoes a step), and what it conserves.

Slides S4, S9; lectures/02_equation_of_motion.md.
"""

from dataclasses import dataclass

from ..compiled import bind
from .euler import explicit_euler, implicit_gyroscopic, symplectic_euler, symplectic_euler_position_first
from .parts import Work, add_scaled, copy, drift, make_work
from .runge_kutta import rk4
from .splitting import compose4, compose6, implicit_midpoint, splitting

__all__ = [
    "INTEGRATORS",
    "Integrator",
    "Work",
    "add_scaled",
    "compose4",
    "compose6",
    "copy",
    "drift",
    "explicit_euler",
    "implicit_gyroscopic",
    "implicit_midpoint",
    "make_work",
    "rk4",
    "splitting",
    "symplectic_euler",
    "symplectic_euler_position_first",
]


@dataclass(frozen=True)
class Integrator:
    """What is claimed of an integrator; the tests measure it.

    order: of the error in h, for smooth forces; symmetric: a step of −h undoes a step, where no force depends
    on velocity; conserves: of a free rigid body, to rounding: "momentum", "energy", or nothing; evaluations:
    of the force in a step; base: the step that a composition repeats; most_drag: h · drag/mass, beyond which
    drag makes velocities grow, since no method here is implicit in it.
    """

    step: object
    order: int
    symmetric: bool = False
    conserves: tuple = ()
    evaluations: int = 1
    base: object = None
    most_drag: float = 2.0

    def bind(self, force):
        """The step with its force fixed: ``step(system, t, h, state, work)``, compiled if the force is."""
        return bind(self.step, bind(self.base, force) if self.base else force)


INTEGRATORS = {
    "explicit_euler": Integrator(explicit_euler, order=1),
    "symplectic_euler": Integrator(symplectic_euler, order=1),
    "symplectic_euler_position_first": Integrator(symplectic_euler_position_first, order=1),
    "implicit_gyroscopic": Integrator(implicit_gyroscopic, order=1),
    "rk4": Integrator(rk4, order=4, evaluations=4, most_drag=2.785293563),
    "splitting": Integrator(splitting, order=2, symmetric=True, conserves=("momentum",)),
    "splitting4": Integrator(
        compose4, 4, symmetric=True, conserves=("momentum",), evaluations=5, base=splitting, most_drag=3.6501
    ),
    "splitting6": Integrator(
        compose6, 6, symmetric=True, conserves=("momentum",), evaluations=9, base=splitting, most_drag=2.6466
    ),
    "implicit_midpoint": Integrator(
        implicit_midpoint, order=2, symmetric=True, conserves=("momentum", "energy")
    ),
}
