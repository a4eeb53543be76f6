"""The joints of a run: made ready for a solver, and what is to be told of them.

Slides S8, S9; lectures/04_embedding.md.
"""

import numpy as np

from ..choice import choose_solver
from ..joints import DISTANCE, LINEAR
from ..mechanism import make_mechanism, rigid_rows, soft_rows
from ..multipliers import MULTIPLIERS
from ..trajectory import Trajectory

NEAR = 1e-5  # a pivot, over what was there before the elimination: dependent rows are not far
CHANGED = 1e-9  # relative change of the state at the start that is told
JUMP = 1e-4  # of the energy that moves: a change between two records for which there is no cause
RARE = 20  # times the usual change between two records; what an integrator errs by is not as rare
MANY = 10  # records; with fewer of them nothing is usual, and a change must be this share of the energy:
UNSEEN = 1e-2


class Joints:
    """The rows of a scene's joints with their solver; ``system`` is the bodies' own with the mechanism."""

    def __init__(self, bodies, solver):
        rigid, soft = rigid_rows(bodies), soft_rows(bodies)
        self.bodies, self.solver, self.choice = bodies, solver, choose_solver(bodies, rigid)
        if self.choice.redundant and solver != "minimum_norm":
            raise ValueError(
                f"solver must be 'minimum_norm' here, since {self.choice.redundant} of {self.choice.rows} "
                f"rows are redundant, but is {solver!r}"
            )
        method = MULTIPLIERS[solver]
        factor = method.prepare(rigid, bodies.system)
        self.mechanism = make_mechanism(bodies, rigid, soft, method.number, factor)
        self.system = bodies.system._replace(mechanism=self.mechanism, velocity_dependent=True)
        self.changed, self.jump = "", ""
        rows = self.mechanism.rows  # a motor, a damper, drag and the user's forces change the energy
        self.keeps_energy = not (bodies.system.velocity_dependent or rows.speed.any() or rows.damping.any())

    @property
    def rows(self):
        """All ``Rows``, rigid ones first."""
        return self.mechanism.rows

    def refuse_start(self):
        """Raise ValueError: the joints can't all hold at the start."""
        m = len(self.mechanism.λ)
        φ = np.abs(self.mechanism.jacobian.φ[:m])
        if self.mechanism.watch[0] <= 0 or not np.isfinite(φ).all():
            raise ValueError(
                "joints must hold at the start, but no position of the bodies was found in which they do: "
                "the search met one in which they depend on each other"
            )
        worst = self.rows.joint[int(np.argmax(φ))]
        joint = self.bodies.joints[worst]
        raise ValueError(
            f"joints must be able to hold at the same time, but joint {worst}, a {type(joint).__name__} of "
            f"bodies {joint.a} and {joint.b}, stays open by {φ.max():.3g} whatever the bodies do: "
            "look at lengths and points of the loop that it closes"
        )

    def compare_start(self, before, state):
        """Keep in mind whether the state had to be changed at the start."""
        n = len(before) - len(state.u)
        moved = np.abs(before[:n] - state.y[:n]).max(initial=0) > CHANGED * self.mechanism.scale
        pushed = np.abs(before[n:] - state.u).max(initial=0) > CHANGED * np.abs(before[n:]).max(initial=0)
        told = [("positions", moved), ("velocities", pushed)]
        names = " and ".join(name for name, is_so in told if is_so)
        self.changed = (
            f"{names} at the start did not fit the joints, and were changed as little as the masses allow"
            if names
            else ""
        )

    @property
    def near(self):
        """Whether loops have come near a singular position."""
        smallest, least, most, _ = self.mechanism.watch
        return self.choice.loops and (smallest < NEAR or most > least)

    def last_credible(self, records):
        """The last of the records y (T, size) that can be believed: T − 1, or the one before energy jumps.

        In a singular position a mechanism can go on in more than one way. Near it a step can come to another
        of them, or be thrown off; what tells is energy that changed where nothing could have changed it.
        """
        if not (self.near and self.keeps_energy):
            return len(records) - 1
        motion = Trajectory(self.bodies, np.arange(len(records)), *self.bodies.unpack(records), contacts=None)
        energy = motion.energy()
        most = (np.square(motion.velocity).sum(axis=2) @ self.bodies.mass / 2).max()
        change = np.abs(np.diff(energy))
        many = len(change) >= MANY  # to tell from them what is usual
        jumps = np.flatnonzero(
            change > (max(JUMP * most, RARE * np.median(change)) if many else UNSEEN * most)
        )
        if not jumps.size:
            return len(records) - 1
        self.jump = (
            f"energy changed by {energy[jumps[0] + 1] - energy[jumps[0]]:.2g} J, though nothing in the scene "
            "could change it, near a singular position of the joints, from where more than one motion is "
            "possible, in"
        )
        return int(jumps[0])

    def failure(self):
        """(status, reason) of a run that ended, or None, where the joints are not what ended it."""
        if self.jump:
            return "singular", self.jump
        smallest, gap = self.mechanism.watch[0], self.mechanism.watch[3]
        if smallest <= 1e-14:
            return (
                "singular",
                "the joints came to depend on each other, so that their forces are not unique, in",
            )
        if gap > 0:
            return "torn", f"a joint stayed open by {gap:.2g} of the mechanism's size in"
        return None

    def note(self):
        """What must be said of a run: redundant joints, a singular position, a start that was changed."""
        said = [self.changed] if self.changed else []
        smallest, least, most, _ = self.mechanism.watch
        m = len(self.mechanism.λ)
        if self.solver == "minimum_norm" and least < m:
            ranks = f"{int(most)}" if least == most else f"{int(least)} to {int(most)}"
            said.append(
                f"the joints are redundant: of {m} rows {ranks} are independent. The motion is unique, "
                "the joints' forces are not: λ is the one with the smallest sum of squares in the rows' own "
                "frames, which adds up N and N m as if they were one"
            )
        if self.near:
            said.append(
                f"the joints came near a singular position (smallest pivot {smallest:.1g}), from where more "
                "than one motion may be possible"
            )
        return "; ".join(said)

    def forces(self, state):
        """(force, torque, λ) of all joints for the state last computed; see ``JointForces``."""
        mechanism, d, n = self.mechanism, self.bodies.dimension, len(self.bodies.joints)
        rows, J, m = mechanism.rows, mechanism.jacobian.J, len(mechanism.λ)
        u = np.zeros((len(state.v) + 1, J.shape[2]))  # the last for the world
        u[:-1, :d], u[: len(state.ω), d:] = state.v, state.ω
        w = np.einsum("ksc,ksc->k", J[m:], u[rows.bodies[m:]])
        soft = -rows.stiffness[m:] * mechanism.jacobian.φ[m:] - rows.damping[m:] * w
        λ = np.concatenate([mechanism.λ, soft])
        force, torque = np.zeros((n, d)), np.zeros((n, J.shape[2] - d))
        np.add.at(force, rows.joint, J[:, 1, :d] * λ[:, None])
        turning = (rows.kind != LINEAR) & (rows.kind != DISTANCE)
        np.add.at(torque, rows.joint[turning], J[turning, 1, d:] * λ[turning, None])
        return force, torque if d == 3 else torque[:, 0], λ
