"""What touched between two records, and with which impulses: the contacts of a ``Trajectory``.

Slides S10, S12; lectures/05_contact.md.
"""

import numpy as np

from ..contacts import part
from ..trajectory import ContactHistory

_FIELDS = "bodies", "point", "frame", "gap", "id"


class Touched:
    """Contacts and impulses as they come, step by step, and closed to one list a record. d dimensions."""

    def __init__(self, d):
        self.d, self.notes, self.last, self.closed = d, [], None, []

    def add(self, contacts, impulse):
        """Keep the contacts (``ContactArrays``) of a flight or an impact, with the impulses (m, d) in
        their frames, N s. The arrays are copied: the next search for contacts writes over them.
        """
        self.last = contacts._replace(**{name: getattr(contacts, name).copy() for name in _FIELDS}), impulse
        self.notes.append(self.last)

    def repeat(self):
        """The same as in the step before."""
        self.notes.append(self.last)

    def mark(self):
        """A place to come ``back_to``."""
        return len(self.notes)

    def back_to(self, mark):
        """Forget what was added since."""
        del self.notes[mark:]

    def close(self, now, slack):
        """End a record. now: the contacts of its state, gap ≤ slack m where they touch; the others count
        if they pushed.
        """
        there = part(now, now.gap <= slack)
        lists = [*self.notes, (there, np.zeros((len(there.gap), self.d)))]
        arrays = [np.concatenate([getattr(c, name) for c, _ in lists]) for name in _FIELDS]
        bodies, point, frame, gap, feature = arrays
        impulse = np.concatenate([i for _, i in lists])
        names = np.column_stack([bodies, feature])
        _, group = np.unique(names, axis=0, return_inverse=True)
        group = group.ravel()
        m = int(group.max(initial=-1)) + 1
        last = np.zeros(m, dtype=int)
        last[group] = np.arange(len(group))  # the latest geometry of each
        world = np.zeros((m, self.d))
        np.add.at(world, group, np.einsum("mi,mij->mj", impulse, frame))
        impulse = np.einsum("mij,mj->mi", frame[last], world)
        apart = last < len(gap) - len(there.gap)  # not any more among what touches
        gap[last[apart]] = np.maximum(gap[last[apart]], slack)
        counts = np.any(impulse != 0, axis=1) | ~apart
        last = last[counts]
        self.closed.append((bodies[last], point[last], frame[last], -gap[last], impulse[counts]))
        self.notes.clear()

    def history(self, records):
        """The ``ContactHistory``: nothing at the first record, then the lists closed since it was asked
        for last.
        """
        if not self.closed:
            return ContactHistory.empty(records, self.d)
        lists, self.closed = self.closed[: records - 1], []
        offsets = np.concatenate([[0, 0], np.cumsum([len(one[0]) for one in lists])])
        return ContactHistory(offsets, *(np.concatenate(arrays) for arrays in zip(*lists, strict=True)))
