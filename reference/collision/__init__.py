"""Finding where bodies touch: shapes as arrays, pairs that are near, contact points with frames and ids.

``make_collider(bodies, scene)`` once, ``find_contacts(collider, state, margin)`` in each step. A pair's
contacts have their gap along n: zero or less where they touch, positive where they will soon.

Slides S10; lectures/05_contact.md.
"""

from .collider import Collider, count_pairs, find_contacts, make_collider
from .find import ContactArrays, detect, detector
from .solids import Solids

__all__ = [
    "Collider",
    "ContactArrays",
    "Solids",
    "count_pairs",
    "detect",
    "detector",
    "find_contacts",
    "make_collider",
]
