"""What can be set of a run, checked; and what the scene needs filled in where nothing was said.

Slides S3, S9; lectures/02_equation_of_motion.md.
"""

from dataclasses import asdict, dataclass, fields, replace

from .. import inputs
from ..compiled import COMPILED
from ..correction import CORRECTIONS
from ..integrators import INTEGRATORS
from ..lcp import SOLVERS
from ..multipliers import MULTIPLIERS
from ..scene import Unsupported
from .fixed_step import FixedStep
from .impacts import IMPACTS
from .smooth import Smooth
from .solving import DEFAULT_SOLVERS, why_unfit
from .velocity_lcp import VelocityLCP


def with_contact(scene, bodies, settings):
    """The velocity-based simulator: from impact to impact, or with S9's fixed step if another correction is
    asked for than the projection.
    """
    made = VelocityLCP if settings.correction[0] == "projection" else FixedStep
    return made(scene, bodies, settings)


SIMULATORS = {"smooth": Smooth, "velocity_lcp": with_contact}
FAMILIES = ("penalty", "impulse", "acceleration_lcp", "velocity_lcp", "reduced", "smooth")  # of S3
FOR_CONTACT = ("friction", "impact", "correction")


@dataclass(frozen=True)
class Settings:
    """The settings of a run; None: chosen by what the scene needs.

    simulator: a family of S3: "smooth", where nothing can touch, else "velocity_lcp". integrator: a name in
    ``INTEGRATORS``, for smooth motion. iterations, tolerance: limits of an implicit integrator's own
    Newton iteration, or of the contact solver's passes (a large heap may be left short: ``cone_newton``).
    substeps: steps of dt/substeps for each dt. record_every: a record each so many dt, and always at the
    end. solver: of the joints' λ, a name in ``MULTIPLIERS``, or of the contacts', a name in ``lcp.SOLVERS``.
    friction: "cone", "box" or "pyramid" (``solving``). correction: a name in ``CORRECTIONS``, or (name,
    {parameter: value}). impact, warm_start, record_contacts: for contact; seed: for what is drawn at random.
    """

    simulator: str | None = None
    solver: str | None = None
    integrator: str | None = None
    friction: str | None = None
    impact: str | None = None
    correction: str | tuple | None = None
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
        inputs.flag("warm_start", given.warm_start), inputs.flag("record_contacts", given.record_contacts)
        given = replace(
            given,
            simulator=simulator,
            substeps=inputs.whole("substeps", given.substeps, least=1),
            record_every=inputs.whole("record_every", given.record_every, least=1),
        )
        return given.for_contact(needs) if simulator == "velocity_lcp" else given.for_smooth(needs)

    def for_contact(self, needs):
        """These settings filled in for contact."""
        if self.integrator is not None:
            raise Unsupported(
                f"integrator={self.integrator!r} has no effect under 'velocity_lcp', which steps by itself"
            )
        friction = "cone" if self.friction is None else self.friction
        inputs.choice("friction", friction, DEFAULT_SOLVERS)
        solver = DEFAULT_SOLVERS[friction] if self.solver is None else self.solver
        inputs.choice("solver", solver, SOLVERS)
        newton = solver == "cone_newton"
        reason = "" if newton and friction == "cone" else why_unfit(solver, friction, needs.rows > 0)
        if reason:
            raise Unsupported(
                f"solver={solver!r} can't treat friction={friction!r}"
                f"{' beside joints' if needs.rows else ''}: {reason}"
            )
        if self.impact is not None:
            inputs.choice("impact", self.impact, [law for law in IMPACTS if law])
        name, parameters = checked_correction(self.correction)
        if name != "projection" and self.impact not in (None, "newton"):
            raise Unsupported(
                f"impact={self.impact!r} can't go with correction={name!r}: its step has one solve, and "
                "knows Newton's law only"
            )
        return replace(
            self,
            friction=friction,
            solver=solver,
            correction=(name, parameters),
            iterations=self._iterations(100 if newton else 1000),
            tolerance=(1e-12 if newton else 1e-10)
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
        if "correction" in shown:
            shown["correction"], shown["correction_parameters"] = self.correction
        return {**shown, "dt": dt, "compiled": COMPILED and not user_forces}


def checked_correction(given):
    """(name, parameters) of a correction: None, a name, or a name with some of its parameters.

    Raises ValueError or TypeError, which name the argument.
    """
    name, changed = given if isinstance(given, tuple) and len(given) == 2 else (given, {})
    if not isinstance(name, (str, type(None))) or not isinstance(changed, dict):
        raise TypeError(f"correction must be a name, or (name, {{parameter: value}}), but is {given!r}")
    name = inputs.choice("correction", "projection" if name is None else name, CORRECTIONS)
    parameters = dict(CORRECTIONS[name])
    for parameter, value in changed.items():
        if parameter not in parameters:
            there = ", ".join(parameters) or "none"
            raise ValueError(f"correction={name!r} has no parameter {parameter!r}: there is {there}")
        what = f"correction's {parameter}"
        if parameter == "sweeps":
            parameters[parameter] = inputs.whole(what, value, least=1)
        elif parameter == "frequency":
            parameters[parameter] = inputs.number(what, value, above=0)
        else:
            parameters[parameter] = inputs.number(what, value, least=0)
    return name, parameters
