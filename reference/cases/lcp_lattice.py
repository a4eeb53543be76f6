"""A large problem that looks like contact: bodies on a lattice, each touching its neighbours.

Slides S15, S17; lectures/07_iterative_lcp.md.
"""

import numpy as np

from .. import inputs
from ..factored import Factored
from ..lcp import LCP
from .lcp_problems import Known


def lattice(contacts=3334, seed=0, factored=False, frictionless=True):
    """About a third as many bodies as ``contacts``, with three rows a contact, and a planted answer.

    Within the lattice a body touches six others, so that a row of A has up to 33 numbers. The rows of J are
    random directions and arms, M is 1; a little softness makes A definite. frictionless: False: of each three
    rows the last two are friction, clipped by the first (μ = 0.5); no answer is known then.
    """
    count = inputs.whole("contacts", contacts, least=1)
    random, side = np.random.default_rng(seed), 2
    while 3 * side**2 * (side - 1) < count:
        side += 1
    number = np.arange(side**3).reshape(side, side, side)
    pairs = [
        np.stack([np.delete(number, side - 1, axis).ravel(), np.delete(number, 0, axis).ravel()], axis=1)
        for axis in range(3)
    ]
    pair = np.concatenate(pairs)
    pair = pair[np.argsort(pair.min(axis=1), kind="stable")][:count]
    n = 3 * count
    J = random.normal(size=(n, 2, 6))
    A = Factored(np.repeat(pair, 3, axis=0), J, J, side**3, np.full(n, 1.0))
    on = random.random(n) < 0.5
    answer, w = np.where(on, 0.5 + random.random(n), 0), np.where(on, 0, 0.5 + random.random(n))
    b = w - A @ answer
    tangential = np.flatnonzero(np.arange(n) % 3)
    friction = None if frictionless else (tangential, tangential - tangential % 3, 0.5)
    problem = LCP(A if factored else A.tosparse(), b, friction=friction)
    return Known(problem, answer if frictionless else None, "planted", "large")
