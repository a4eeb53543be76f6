"""What can be set of a run, checked; and what the scene needs filled in where nothing was said.

Slides S3, S9; lectures/02_equation_of_motion.md.
"""

from dataclasses import asdict, dataclass, fields, replace

from .. import inputs
from ..compiled import COMPILED
from ..integrators import INTEGRATORS
from ..multipliers import MULTIPLIERS
from ..scene import Unsupported
from .smooth import Smooth

SIMULATORS = {"smooth": Smooth}
FAMILIES = ("penalty", "impulse", "acceleration_lcp", "velocity_lcp", "reduced", "smooth")  # of S3
FOR_CONTACT = ("friction", "impact", "correction")


@dataclass(frozen=True)
class Settings:
    """The settings of a run; None: chosen by what the scene needs.

    simulator: a family of S3: "smooth", where nothing can touch. integrator: a name in ``INTEGRATORS``.
    iterations, tolerance: limits of an implicit integrator's own Newton iteration. substeps: steps of
    dt/substeps for each dt. record_every: a record each so many dt, and always at the end. solver: of the
    joints' λ, a name in ``MULTIPLIERS``. friction, impact, correction, warm_start, record_contacts: for
    contact; seed: for what is drawn at random.
    """

    simulator: str | None = None
    solver: str | None = None
    integrator: str | None = None
    friction: str | None = None
    impact: str | None = None
    correction: str | None = None
    iterations: int | None = None
    tolerance: float | None = None
    substeps: int = 1
    warm_start: bool = True
    seed: int = 0
    record_every: int = 1
    record_contacts: bool = True

    @classmethod
    def chosen(cls, needs, **settings):
        """The settings given, checked, and the rest from ``needs``, the scene's ``Model``.

        Raises ValueError or TypeError for bad values and unknown names, Unsupported for what isn't there.
        """
        for name in settings:
            inputs.choice("a setting's name", name, [field.name for field in fields(cls)])
        given = cls(**settings)
        simulator = needs.simulator if given.simulator is None else given.simulator
        if inputs.choice("simulator", simulator, FAMILIES) not in SIMULATORS:
            there = ", ".join(SIMULATORS)
            raise Unsupported(f"simulator {simulator!r} is not part of the course yet: there is {there}")
        for name in FOR_CONTACT:
            if getattr(given, name) is not None:
                raise Unsupported(
                    f"{name}={getattr(given, name)!r} has no effect under {simulator!r}: without contact "
                    "there is nothing for it to do"
                )
        solver = needs.solver if given.solver is None else given.solver
        if needs.solver is not None:
            inputs.choice("solver", solver, MULTIPLIERS)
        elif solver is not None:
            raise Unsupported(f"solver={solver!r} has no effect: without joints there is nothing to solve")
        integrator = needs.integrator if given.integrator is None else given.integrator
        inputs.whole("seed", given.seed)
        return replace(
            given,
            simulator=simulator,
            solver=solver,
            integrator=inputs.choice("integrator", integrator, INTEGRATORS),
            iterations=30
            if given.iterations is None
            else inputs.whole("iterations", given.iterations, least=1),
            tolerance=1e-14
            if given.tolerance is None
            else inputs.number("tolerance", given.tolerance, least=0),
            substeps=inputs.whole("substeps", given.substeps, least=1),
            record_every=inputs.whole("record_every", given.record_every, least=1),
        )

    def told(self, dt, user_forces):
        """What a Trajectory tells: the settings that had an effect, dt, whether loops are compiled."""
        shown = {name: value for name, value in asdict(self).items() if name not in FOR_CONTACT}
        return {**shown, "dt": dt, "compiled": COMPILED and not user_forces}
