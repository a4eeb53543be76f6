"""What a run leaves behind: the motion of all bodies, and what can be measured on it.

Arrays only; a trajectory of ours and one of an engine are the same class, so whatever measures one measures
the other.

Slides S9, S18; lectures/02_equation_of_motion.md.
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from .forces import potential_energy
from .layout import Bodies
from .mechanism import spring_energy, worst_gap
from .rotation import rotation_matrix


@dataclass(frozen=True)
class BodyState:
    """All n bodies at one time, in the order added, world frame; what ``simulate(..., start=)`` takes.

    time: s; position, velocity: (n, d); orientation: (n, 4) or (n,); angular_velocity: (n, 3) or (n,).
    """

    time: float
    position: np.ndarray
    orientation: np.ndarray
    velocity: np.ndarray
    angular_velocity: np.ndarray


@dataclass(frozen=True)
class Contacts:
    """The m contacts of one record. bodies (m, 2), lower number first; point (m, d); frame (m, d, d), rows n,
    t1, t2, n from first to second; depth (m,), below 0 where they are apart; impulse (m, d) in that frame,
    N s, summed since the record before. What has parted since has the point and frame that it had last.
    """

    bodies: np.ndarray
    point: np.ndarray
    frame: np.ndarray
    depth: np.ndarray
    impulse: np.ndarray


class ContactHistory:
    """The contacts of all records: ``history[k]`` is a ``Contacts`` of views into flat arrays; row
    offsets (T + 1,).
    """

    def __init__(self, offsets, *arrays):
        self.offsets, self.arrays = offsets, arrays

    @classmethod
    def empty(cls, records, d):
        """No contact in any of the records, in d dimensions."""
        shapes = (0, 2), (0, d), (0, d, d), (0,), (0, d)
        return cls(
            np.zeros(records + 1, dtype=int), *(np.zeros(s, int if s == (0, 2) else float) for s in shapes)
        )

    def __len__(self):
        return len(self.offsets) - 1

    def __getitem__(self, k):
        k = range(len(self))[k]  # negative indices, and IndexError
        return Contacts(*(array[self.offsets[k] : self.offsets[k + 1]] for array in self.arrays))


class JointForces(NamedTuple):
    """What the joints do at T times, in world axes: on body b of each joint, on a where b is the world.

    force (T, joints, d) N; torque (T, joints, 3) or (T, joints) N m, about the joint's point on that body; λ
    (T, m) N or N m, in the rows' own frame, rigid rows first, then springs; joint (m,): whose each row is.
    """

    force: np.ndarray
    torque: np.ndarray
    λ: np.ndarray
    joint: np.ndarray


@dataclass(frozen=True)
class Trajectory:
    """The motion of all n bodies at T times, static ones too, in the order added; world frame, SI units.

    time (T,), from 0; start_time: what the clock showed then, s; position (T, n, d); orientation (T, n, 4) or
    (T, n) in the plane; velocity (T, n, d); angular_velocity (T, n, 3) or (T, n); contacts[k]: ``Contacts``;
    status: "ok", or "diverged", "singular", "torn", after which there are no more records;
    reason: a sentence; residual,
    iterations (T,): of the step's own equation, the worst since the record before; settings: what was chosen;
    find_joint_forces: a function that does, or None.
    """

    bodies: Bodies = field(repr=False)
    time: np.ndarray = field(repr=False)
    position: np.ndarray = field(repr=False)
    orientation: np.ndarray = field(repr=False)
    velocity: np.ndarray = field(repr=False)
    angular_velocity: np.ndarray = field(repr=False)
    contacts: ContactHistory = field(repr=False)
    status: str = "ok"
    reason: str = ""
    residual: np.ndarray = field(default=None, repr=False)
    iterations: np.ndarray = field(default=None, repr=False)
    settings: dict = field(default_factory=dict)
    start_time: float = 0.0
    find_joint_forces: object = field(default=None, repr=False)

    def state(self, k=-1):
        """The ``BodyState`` of record k, by default the last: serves as ``start=`` of another run."""
        arrays = self.position, self.orientation, self.velocity, self.angular_velocity
        return BodyState(self.start_time + float(self.time[k]), *(array[k].copy() for array in arrays))

    def energy(self):
        """Kinetic, and potential of gravity, springs (joints' too) and gravitation, J: (T,)."""
        kinetic = 0.5 * np.square(self.velocity).sum(axis=-1) @ self.bodies.mass
        kinetic = kinetic + 0.5 * (self._spin * self.angular_velocity).reshape(len(self.time), -1).sum(
            axis=-1
        )
        potential = potential_energy(self.bodies, self.position, self.orientation)
        if self.bodies.joints:
            potential = potential + spring_energy(self.bodies, self.position, self.orientation)
        return kinetic + potential

    def momentum(self):
        """Σ m v, kg m/s: (T, d)."""
        return np.einsum("i,tik->tk", self.bodies.mass, self.velocity)

    def angular_momentum(self):
        """Σ x × m v + I ω about the world's origin, kg m²/s: (T, 3), or (T,) in the plane."""
        x, p = self.position, self.bodies.mass[:, None] * self.velocity
        if self.bodies.dimension == 2:
            return (x[..., 0] * p[..., 1] - x[..., 1] * p[..., 0] + self._spin).sum(axis=1)
        return (np.cross(x, p) + self._spin).sum(axis=1)

    def joint_error(self):
        """The worst gap in any joint, m: (T,); 0 where there is none.

        Angles count as what they open at the end of the longest arm from a centre of mass to a joint.
        """
        if not self.bodies.joints:
            return np.zeros(len(self.time))
        return worst_gap(self.bodies, self.position, self.orientation)

    def joint_forces(self):
        """What the joints do at each record: a ``JointForces``. Computed when asked for, from the motion.

        Raises ValueError for a run that can't tell, such as an engine's.
        """
        if self.find_joint_forces is None:
            raise ValueError("joint_forces() needs a run of this course's simulators, not an engine's")
        return self.find_joint_forces()

    def penetration(self):
        """The depth of the deepest contact, m: (T,); 0 where there is none.

        Raises ValueError for a run that did not record its contacts.
        """
        if not self.settings.get("record_contacts", True):
            raise ValueError("penetration() needs contacts: run with record_contacts=True, not False")
        deepest = [np.max(self.contacts[k].depth, initial=0.0) for k in range(len(self.time))]
        return np.array(deepest) + 0.0  # no −0

    @cached_property
    def _spin(self):
        """I ω of each body about its centre, world frame: (T, n, 3) or (T, n)."""
        if self.bodies.dimension == 2:
            return self.bodies.inertia * self.angular_velocity
        R = rotation_matrix(self.orientation)
        in_body = np.einsum("tnji,tnj->tni", R, self.angular_velocity)
        return np.einsum("tnij,njk,tnk->tni", R, self.bodies.inertia, in_body, optimize=True)
