"""What can be set of a run, checked; and what the scene needs filled in where nothing was said.

Slides S3, S9; lectures/02_equation_of_motion.md.
"""

from dataclasses import asdict, dataclass, fields, replace

from .. import inputs
from ..compiled import COMPILED
from ..integrators import INTEGRATORS
from ..multipliers import MULTIPLIERS
from ..scene import Unsupported
from .impacts import IMPACTS
from .smooth import Smooth
from .velocity_lcp import VelocityLCP

SIMULATORS = {"smooth": Smooth, "velocity_lcp": VelocityLCP}
FAMILIES = ("penalty", "impulse", "acceleration_lcp", "velocity_lcp", "reduced", "smooth")  # of S3
FOR_CONTACT = ("friction", "impact", "correction")
CONTACT_CHOICES = {  # what contact can be computed with so far
    "solver": ("cone_newton",),
    "friction": ("cone",),
    "impact": tuple(law for law in IMPACTS if law),
    "correction": ("projection",),
}


@dataclass(frozen=True)
class Settings:
    """The settings of a run; None: chosen by what the scene needs.

    simulator: a family of S3: "smooth", where nothing can touch, else "velocity_lcp". integrator: a name in
    ``INTEGRATORS``, for smooth motion. iterations, tolerance: limits of an implicit integrator's own
    Newton iteration, or of the contact solver's passes. substeps: steps of dt/substeps for each dt.
    record_every: a record each so many dt, and always at the end. solver: of the joints' λ, a name in
    ``MULTIPLIERS``, or of the contacts'. friction, impact, correction, warm_start, record_contacts: for
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
        if simulator != needs.simulator:
            raise Unsupported(
                f"simulator {simulator!r} can't run this scene: "
                + (
                    "what can touch, or has limits, makes an LCP"
                    if needs.simulator == "velocity_lcp"
                    else "nothing in it can touch"
                )
                + f", so it needs {needs.simulator!r}"
            )
        inputs.whole("seed", given.seed)
        given = replace(
            given,
            simulator=simulator,
            substeps=inputs.whole("substeps", given.substeps, least=1),
            record_every=inputs.whole("record_every", given.record_every, least=1),
        )
        return given.for_contact() if simulator == "velocity_lcp" else given.for_smooth(needs)

    def for_contact(self):
        """These settings filled in for contact."""
        if self.integrator is not None:
            raise Unsupported(
                f"integrator={self.integrator!r} has no effect under 'velocity_lcp', which steps by itself"
            )
        chosen = {}
        for name, known in CONTACT_CHOICES.items():
            value = getattr(self, name)
            if value is not None and value not in known:
                raise Unsupported(
                    f"{name}={value!r} is not part of the course yet: there is {', '.join(known)}"
                )
            chosen[name] = value if name == "impact" else known[0]
        return replace(
            self,
            **chosen,
            iterations=self._iterations(100),
            tolerance=1e-12
            if self.tolerance is None
            else inputs.number("tolerance", self.tolerance, above=0),
        )

    def for_smooth(self, needs):
        """These settings filled in for motion without contact."""
        for name in FOR_CONTACT:
            if getattr(self, name) is not None:
                raise Unsupported(
                    f"{name}={getattr(self, name)!r} has no effect under {self.simulator!r}: without contact "
                    "there is nothing for it to do"
                )
        solver = needs.solver if self.solver is None else self.solver
        if needs.solver is not None:
            inputs.choice("solver", solver, MULTIPLIERS)
        elif solver is not None:
            raise Unsupported(f"solver={solver!r} has no effect: without joints there is nothing to solve")
        integrator = needs.integrator if self.integrator is None else self.integrator
        return replace(
            self,
            solver=solver,
            integrator=inputs.choice("integrator", integrator, INTEGRATORS),
            iterations=self._iterations(30),
            tolerance=1e-14
            if self.tolerance is None
            else inputs.number("tolerance", self.tolerance, least=0),
        )

    def _iterations(self, otherwise):
        return otherwise if self.iterations is None else inputs.whole("iterations", self.iterations, least=1)

    def told(self, dt, user_forces):
        """What a Trajectory tells: the settings that had an effect, dt, whether loops are compiled."""
        without = ("integrator",) if self.simulator == "velocity_lcp" else FOR_CONTACT
        shown = {name: value for name, value in asdict(self).items() if name not in without}
        return {**shown, "dt": dt, "compiled": COMPILED and not user_forces}
