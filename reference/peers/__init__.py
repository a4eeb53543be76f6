"""Peers: the same Scene in real engines, giving the same Trajectory.

``simulate_in(scene, "pymunk", duration, dt)`` runs it; ``ENGINES["pybullet"].load(scene, dt)`` makes it ready
to be stepped by ``advance``, apart from setting it up. What each engine really does is written in its
adapter's docstring: ``pymunk_peer`` (in the plane) and ``pybullet_peer`` (in space); of contact, in
``pymunk_contact`` and ``pybullet_contact``.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

from ..scene import Unsupported
from .engine import Engine, Peer
from .pybullet_peer import PYBULLET
from .pymunk_peer import PYMUNK

ENGINES = {engine.name: engine for engine in (PYMUNK, PYBULLET)}


def simulate_in(scene, engine, duration, dt, *, record_every=1, record_contacts=True, **settings):
    """Run a scene in an engine and return its Trajectory; ``run.settings`` says engine, version and settings.

    engine: "pymunk" for scenes in the plane, "pybullet" for scenes in space. settings: the engine's own, see
    ``ENGINES[engine].settings``: name → (default, what is allowed). Raises Unsupported where the engine can't
    express the scene or is not installed, ValueError for an unknown engine or setting.
    """
    if engine not in ENGINES:
        raise ValueError(f"engine must be one of {', '.join(ENGINES)}, but is {engine!r}")
    with ENGINES[engine].load(scene, dt, **settings) as peer:
        return peer.run(duration, record_every, record_contacts)


__all__ = ["ENGINES", "Engine", "Peer", "Unsupported", "simulate_in"]
