"""What both adapters share: which engine is there, its settings, and how its states become a Trajectory.

An adapter is a subclass of Peer: it builds the engine's own scene, steps it, and reads its bodies.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import importlib.util
import math
from collections.abc import Callable
from dataclasses import dataclass
from importlib import metadata

import numpy as np

from .. import inputs
from ..scene import Unsupported
from .forces import Snapshot


@dataclass(frozen=True)
class Engine:
    """An engine: ``load(scene, dt, **settings)`` gives a Peer that steps the scene in it.

    settings: name → (default, what is allowed: a tuple of words, or the smallest whole number).
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
        """The scene in this engine, at its start: a Peer. Raises Unsupported for what the engine can't express."""
        chosen = self._checked(settings)
        if not self.available:
            raise Unsupported(
                f"{self.name} is not installed for this Python: {self.install}. Where it has no wheel, the recordings "
                "in reference/peers/recordings serve: see reference.peers.recorded.")
        if scene.dimension != self.dimension:
            other = {2: ("the plane", "pybullet"), 3: ("space", "pymunk")}[self.dimension]
            raise Unsupported(f"{self.name} knows only {other[0]}, and this scene has {scene.dimension} dimensions: use {other[1]}")
        meeting = next(iter(scene.colliding_pairs()), None)
        if meeting:
            raise Unsupported(
                f"contact is not passed on to {self.name} by this adapter, and the bodies {meeting[0]} and {meeting[1]} "
                "could touch: say scene.pair(i, j, collide=False), or put them in one group")
        return self.adapter(self, scene, inputs.number("dt", dt, above=0), chosen)

    def _checked(self, settings):
        valid = "; ".join(f"{name} ({_allowed(allowed)})" for name, (_, allowed) in self.settings.items())
        chosen = {name: default for name, (default, _) in self.settings.items()}
        for name, value in settings.items():
            if name not in chosen:
                raise ValueError(f"{name!r} is no setting of {self.name}, which has: {valid}")
            allowed = self.settings[name][1]
            chosen[name] = inputs.choice(name, value, allowed) if isinstance(allowed, tuple) else inputs.whole(name, value, least=allowed)
        return chosen


def _allowed(allowed):
    return " or ".join(map(repr, allowed)) if isinstance(allowed, tuple) else f"a whole number of at least {allowed}"


class Peer:
    """A scene inside an engine, being stepped. Use it as a context, or call ``close()``.

    ``advance(duration)`` steps and reads nothing, so that its time is the engine's; ``state`` reads the engine.
    """

    def __init__(self, engine, scene, dt, settings):
        self.engine, self.scene, self.dt, self.settings = engine, scene, dt, settings
        self.moving = [i for i, body in enumerate(scene.bodies) if not body.static]
        self.steps = 0
        d, n = scene.dimension, len(scene.bodies)
        self._rest = Snapshot(  # what is static stays so; the rest is read from the engine
            0.0, np.array([body.position for body in scene.bodies]).reshape(n, d),
            np.array([body.orientation for body in scene.bodies], dtype=float).reshape((n, 4) if d == 3 else n),
            np.zeros((n, d)), np.zeros((n, 3) if d == 3 else n))

    @property
    def time(self):
        """Seconds since the scene's start."""
        return self.steps * self.dt

    @property
    def state(self):
        """All bodies now: a Snapshot, shaped as one record of a Trajectory."""
        now = Snapshot(self.time, *(array.copy() for array in self._rest[1:]))
        for i, body in zip(self.moving, self.read(), strict=True):
            for array, value in zip(now[1:], body, strict=True):
                array[i] = value
        return now

    def advance(self, duration):
        """Step for ``duration``, a whole number of dt."""
        steps = whole_steps(duration, self.dt)
        self.run(steps)
        self.steps += steps

    def run(self, steps):
        """Take the steps; the adapter's own loop."""
        raise NotImplementedError

    def read(self):
        """The moving bodies, each (position, orientation, velocity, angular velocity); the adapter's own."""
        raise NotImplementedError

    def close(self):
        """Give back what the engine holds."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def whole_steps(duration, dt):
    """How many steps of dt make up the duration; an error where it isn't a whole number."""
    duration = inputs.number("duration", duration, least=0)
    steps = round(duration / dt)
    if not math.isclose(steps * dt, duration, rel_tol=1e-9, abs_tol=1e-12):
        raise ValueError(f"duration must be a whole number of dt = {dt!r}, but is {duration!r}, {duration / dt:.9g} of them")
    return steps
