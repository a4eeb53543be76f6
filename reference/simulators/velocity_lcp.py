"""The velocity-based simulator, the widely used one: contact at the level of velocities and impulses (S12).

A step of Δt, as S9 has it: find the contacts; solve w = A λ + b for the impulses, which stop what would go into each
other; with them the new velocities; with these the new positions. What drifted is put back first (S13).

Slides S9–S12; lectures/05_contact.md. Source: Stewart & Trinkle, Int. J. Numer. Methods Eng. 39 (1996) 2673; Anitescu & Potra, Nonlinear
Dynamics 14 (1997) 231.
"""

import numpy as np

from ..bodies import solve_mass
from ..collision import find_contacts, make_collider
from ..compiled import bind, compiled
from ..contacts import contact_rows, fill_masses, label_islands
from ..forces import external_force, with_user_forces
from ..integrators import make_work
from ..lcp.cone_newton import cone_newton_kernel
from ..trajectory import BodyState
from .flight import choose_velocities, gather_velocities, let_rest, move
from .smooth import all_finite


@compiled
def fill_free(force, system, t, h, state, M, before, f, τ, free):
    """The velocities after h without contact: u + Δt M⁻¹ f_e, into free (n, k); M (n, k, k) and u, before, are filled too."""
    fill_masses(system, state, M)
    gather_velocities(state, before)
    force(system, t, state, f, τ)
    solve_mass(system, state.q, f, τ)
    d = f.shape[1]
    free[:] = before
    for i in range(len(f)):
        for a in range(d):
            free[i, a] += h * f[i, a]
        if i < len(τ):
            for a in range(τ.shape[1]):
                free[i, d + a] += h * τ[i, a]


class VelocityLCP:
    """A scene made ready to run with contact: ``advance`` moves ``state``, and records if told to."""

    def __init__(self, scene, bodies, user_forces=(), tolerance=1e-12, iterations=100, impact="newton"):
        self.bodies, self.system, self.state = bodies, bodies.system, bodies.state()
        self.collider = make_collider(bodies, scene)
        self.tolerance, self.iterations, self.impact = tolerance, iterations, impact
        force = external_force
        if user_forces:
            force = with_user_forces(bodies, tuple(user_forces), self.public_state)
        self.fill_free = bind(fill_free, force)
        n, d = self.state.x.shape
        self.k = 6 if d == 3 else 3
        self.M, self.before, self.free = np.zeros((n, self.k, self.k)), np.zeros((n, self.k)), np.zeros((n, self.k))
        self.f, self.τ = np.zeros((n, d)), np.zeros_like(self.state.ω)
        self.work = make_work(n, len(self.state.q), d, 30, 1e-15)
        radius = self.collider.solids.radius
        self.size = float(radius[np.isfinite(radius)].min())
        self.key, self.force = np.zeros(0, dtype=np.int64), np.zeros((0, d))  # of the contacts of the step before, N
        self.stats = []

    def public_state(self, t, state):
        return BodyState(t, *(array[0] for array in self.bodies.unpack(state.y[None])))

    def step(self, t, h):
        """One step of S9."""
        left, hops = h, 0
        while left > 0:
            self.fill(t + h - left, left)
            touching = self.touching(left)
            touching = self.lift(touching, left)
            if hops < MOST_IMPACTS and self.strike(touching, h):
                self.fill(t + h - left, left)
            bouncing = self.bouncing(touching) if hops < MOST_IMPACTS else None
            hop = self.fly(touching, bouncing, t + h - left, left)
            left = left - hop if hop < left else 0.0
            hops += 1

    def fill(self, t, h):
        self.fill_free(self.system, t, h, self.state, self.M, self.before, self.f, self.τ, self.free)

    def touching(self, h):
        """All contacts that could matter within h."""
        reach = 2 * h * h * (np.abs(self.free - self.before).max(initial=0.0) / h)
        find_contacts(self.collider, self.state, reach + 1e-6 * self.size, h)
        return self.collider.contacts

    def slack(self):
        return 1e-9 * self.size

    def remembered(self, contacts, rows, h):
        """Start of the solver: the impulses that go with the forces of the step before."""
        m, d = contacts.count[0], self.state.x.shape[1]
        key = (contacts.bodies[:m, 0] * 1000003 + contacts.bodies[:m, 1]) * 2**32 + contacts.id[:m]
        λ = np.zeros((m, d))
        if len(self.key):
            order = np.argsort(self.key, kind="stable")
            at = np.minimum(np.searchsorted(self.key[order], key), len(order) - 1)
            same = self.key[order][at] == key
            λ[same] = h * self.force[order][at[same]]
        used = np.arange(d)[None] < np.diff(rows.block)[:, None]
        return key, λ[used], used

    def solve(self, contacts, target, h, free):
        rows = contact_rows(contacts, target, self.k)
        key, λ, used = self.remembered(contacts, rows, h)
        history = np.zeros(0)
        after, passes, error = cone_newton_kernel(rows, self.M, free, True, λ, self.tolerance, self.iterations, history)
        self.stats.append((passes, error))
        return rows, key, used, λ, after

    def lift(self, contacts, h):
        return contacts

    def strike(self, contacts, h):
        return False

    def bouncing(self, contacts):
        return None

    def fly(self, contacts, bouncing, t, h):
        m = contacts.count[0]
        gap = contacts.gap[:m]
        target = np.maximum(gap, 0.0) / h
        rows, key, used, λ, after = self.solve(contacts, target, h, self.free)
        label = label_islands(rows.bodies, len(after))
        pressed = np.zeros(len(after), dtype=bool)
        normal = λ[rows.block[:-1]] > 0
        for side in range(2):
            b = contacts.slot[:m, side]
            pressed[b[normal & (b >= 0)]] = True
        let_rest(label, pressed, self.before, self.free, after, 100 * self.tolerance)
        velocities = np.empty_like(after)
        choose_velocities(rows, label, gap, self.before, after, λ, h, np.full(m, self.slack()), velocities)
        move(self.system, velocities, after, h, self.state, self.work)
        force = np.zeros(used.shape)
        force[used] = λ / h
        self.key, self.force = key, force
        self.λ, self.rows = λ, rows
        return h

MOST_IMPACTS = 50
