"""What both adapters share: which engine is there, its settings, and how its states become a Trajectory.

An adapter is a subclass of Peer: it builds the engine's own scene, steps it, and reads its bodies.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import importlib.util
from collections.abc import Callable
from dataclasses import dataclass
from importlib import metadata
from typing import NamedTuple

import numpy as np

from .. import inputs
from ..layout import Bodies
from ..scene import Unsupported
from ..simulators.simulate import count_steps
from ..trajectory import BodyState, ContactHistory, Trajectory
from .touching import Touching, solid_numbers


class Between(NamedTuple):
    """Numbers from low to high are allowed."""

    low: float
    high: float


@dataclass(frozen=True)
class Engine:
    """An engine: ``load(scene, dt, **settings)`` gives a Peer that steps the scene in it.

    name: of the Python package; settings: name → (default, what is allowed: a tuple of words, the smallest
    whole number, or numbers ``Between`` two); install: a sentence; adapter: the Peer's class.
    """

    name: str
    dimension: int
    settings: dict
    install: str
    adapter: Callable

    @property
    def available(self):
        """Whether it can be imported here."""
        return importlib.util.find_spec(self.name) is not None

    @property
    def version(self):
        """The installed version, or None."""
        return metadata.version(self.name) if self.available else None

    def load(self, scene, dt, **settings):
        """The scene in this engine, at its start: a Peer. Raises Unsupported for what the engine can't do."""
        chosen = self._checked(settings)
        self._check_scene(scene)
        if not self.available:
            raise Unsupported(
                f"{self.name} is not installed for this Python: {self.install}. Where it can't be, "
                "recordings of it serve: see reference.peers.recorded"
            )
        return self.adapter(self, scene, inputs.number("dt", dt, above=0), chosen)

    def _check_scene(self, scene):
        if scene.dimension != self.dimension:
            lacks = "no third dimension" if self.dimension == 2 else "no planar bodies"
            other = "pybullet" if self.dimension == 2 else "pymunk"
            raise Unsupported(
                f"{self.name} has {lacks}, but this scene has {scene.dimension} dimensions: use {other}"
            )

    def _checked(self, settings):
        valid = "; ".join(f"{name}: {_allowed(allowed)}" for name, (_, allowed) in self.settings.items())
        chosen = {name: default for name, (default, _) in self.settings.items()}
        for name, value in settings.items():
            if name not in chosen:
                raise ValueError(f"{name!r} is no setting of {self.name}, which has {valid}")
            chosen[name] = _checked_value(name, value, self.settings[name][1])
        return chosen


def _checked_value(name, value, allowed):
    if isinstance(allowed, Between):
        result = inputs.number(name, value)
        if not allowed.low <= result <= allowed.high:
            raise ValueError(f"{name} must be {_allowed(allowed)}, but is {value!r}")
        return result
    if isinstance(allowed, tuple):
        return inputs.choice(name, value, allowed)
    return inputs.whole(name, value, least=allowed)


def _allowed(allowed):
    if isinstance(allowed, Between):
        return f"a number from {allowed.low:g} to {allowed.high:g}"
    return " or ".join(map(repr, allowed)) if isinstance(allowed, tuple) else f"a whole number from {allowed}"


class Peer:
    """A scene inside an engine, being stepped. Use it in a ``with`` statement, or call ``close()``.

    ``advance(duration)`` steps and reads nothing that the forces don't need, so its time is the engine's;
    ``state`` reads all bodies; ``run(duration)`` leaves a Trajectory. moving: the numbers of the bodies that
    are not static. touching: the contacts, read only by ``run``; None where nothing can touch.
    """

    def __init__(self, engine, scene, dt, settings):
        self.engine, self.scene, self.dt = engine, scene, dt
        self.substeps = settings["substeps"]
        self.settings = {"engine": engine.name, "version": engine.version, "dt": dt, **settings}
        self.bodies, self.steps = Bodies(scene), 0
        self.moving = [i for i, body in enumerate(scene.bodies) if not body.static]
        self.touching = Touching(scene.dimension) if solid_numbers(scene) else None

    @property
    def time(self):
        """Seconds since the scene's start."""
        return self.steps * self.dt

    @property
    def state(self):
        """All bodies now: a ``BodyState``."""
        start = self.bodies  # what is static stays where the scene has put it
        arrays = [
            a.copy() for a in (start.position, start.orientation, start.velocity, start.angular_velocity)
        ]
        for i, body in zip(self.moving, self.read(), strict=True):
            for array, value in zip(arrays, body, strict=True):
                array[i] = value
        return BodyState(self.time, *arrays)

    def advance(self, duration):
        """Step for ``duration``, a whole number of dt."""
        self._take(count_steps(duration, self.dt))

    def run(self, duration, record_every=1, record_contacts=True):
        """Step for ``duration``, recording every so many steps and at the end: a Trajectory.

        record_contacts: reading them takes longer than stepping.
        """
        steps, every = count_steps(duration, self.dt), inputs.whole("record_every", record_every, least=1)
        done = np.append(np.arange(0, steps, every), steps)
        states = [self.state]
        noted = inputs.flag("record_contacts", record_contacts)
        watched = self.touching is not None and noted
        if watched:
            self.watch()
        for count in np.diff(done):
            self._take(int(count))
            if watched:
                self.touching.close()
            states.append(self.state)
            if not all(np.isfinite(array).all() for array in _arrays(states[-1])):
                states.pop()
                break
        kept, whole = len(states), len(states) == len(done)
        time = states[0].time + done[:kept] * duration / steps
        stopped = f"the state stopped being finite after t = {time[-1]:.6g} s; try a smaller dt"
        return Trajectory(
            self.bodies,
            time,
            *(np.array(history) for history in zip(*map(_arrays, states), strict=True)),
            contacts=self.touching.history(kept)
            if watched
            else ContactHistory.empty(kept, self.scene.dimension),
            status="ok" if whole else "diverged",
            reason="" if whole else stopped,
            residual=np.zeros(kept),
            iterations=np.zeros(kept, dtype=int),
            settings={**self.settings, "record_contacts": noted},
        )

    def _take(self, steps):
        self.step(steps)
        self.steps += steps

    def step(self, steps):
        """Take so many steps of dt, each of ``substeps`` of the engine's own; the adapter's loop."""
        raise TypeError("an adapter must define step(steps)")

    def watch(self):
        """From now on, ``step`` adds its contacts to ``touching``."""
        self.touching.on = True

    def read(self):
        """The moving bodies, each as (position, orientation, velocity, angular velocity)."""
        raise TypeError("an adapter must define read()")

    def close(self):
        """Give back what the engine holds."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def _arrays(state):
    return state.position, state.orientation, state.velocity, state.angular_velocity
