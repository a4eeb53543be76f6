"""The time of an impact: when the first of what is about to meet does, as the root of its gap over the time.

The bodies fly for a while as if what is to come did not; the gaps that are left tell whether that was too
long. Had nothing else touched them they would fly as stones do, and gaps be parabolas: the first guesses are
such. After them come straight lines through the last two tries, and halves.

Slides S9, S10; lectures/05_contact.md. Source: Dekker, Finding a zero by means of successive linear
interpolation (1969).
"""

import numpy as np

from ..compiled import compiled
from ..contacts import keys, part
from ..lcp.augmented import dot
from .bouncing import SHORT, look_ahead

MOST_TRIES, PARABOLAS = 60, 2
SHORTEST = 1e-9  # of the time searched: less is no flight


def hop(sim, contacts, h, left, early):
    """Move on by what is left of a step of h, or until the next impact; returns by how much, s.

    early: s, how long before the impact will do.
    """
    w, rate, _, _, to_come = look_ahead(contacts, sim.speeds, sim.filled, h, left, early, sim.closed)
    if to_come.any():
        contacts = part(contacts, np.arange(len(w)))  # a copy: what flights find is put in the same place
    while to_come.any():
        flight = Flight(sim, contacts, to_come, left)
        time, pressed = flight.until_met(w[to_come], rate[to_come], early, max(early, SHORT * h))
        if not pressed.any():
            return time
        to_come[np.flatnonzero(to_come)[pressed]] = False
        sim.restore(flight.start)
    return sim.fly(contacts, left)


class Flight:
    """A flight, tried for several times, in which what is to come is not seen."""

    def __init__(self, sim, contacts, to_come, left):
        self.sim, self.start, self.left = sim, sim.keep(), left
        self.coming, self.others = part(contacts, to_come), part(contacts, ~to_come)
        self.gap = np.maximum(self.coming.gap, 0.0)  # what touches is as good as never in each other
        self.touching, self.slack = self.gap <= sim.closed, 0.5 * sim.closed

    def gaps_after(self, time):
        """The gaps of what is to come (c,), once the bodies have flown for this time."""
        sim = self.sim
        sim.restore(self.start)
        sim.fly(self.others, time)
        return gaps_now(self.coming, self.others, sim.find(self.left), sim.limits.bodies) + (
            self.gap - self.coming.gap
        )

    def until_met(self, w, rate, early, brief):
        """Fly until the first meets; returns the time that it took, s, and which (c,) did not part at all:
        what touches, and is back within so ``brief`` a time, s. early: s, see ``hop``.
        """
        gap, left, slack = self.gap, self.left, self.slack
        unhindered = gap + left * (w + 0.5 * left * rate)
        time = meeting(gap, w, unhindered, left, slack)
        end = max(time - 0.5 * early, 0.5 * time) if time < left else left
        gaps, nothing = self.gaps_after(end), np.zeros(len(gap), dtype=bool)
        if 0 <= gaps.min() and (early or gaps.min() <= 2 * slack):
            return end, nothing
        if gaps.min() > 0 and end < left:
            gaps, end = self.gaps_after(left), left
        if gaps.min() >= slack:
            end = self.passing(unhindered, gaps)
            if end == left:
                return left, nothing
            gaps = self.gaps_after(end)
            if gaps.min() >= 0:
                return end, nothing
        return self.search(w, end, gaps, early, brief)

    def passing(self, unhindered, gaps):
        """When the first of what went right through another was there, had it flown on; else ``left``."""
        through = (unhindered < -self.sim.closed) & ~self.touching & np.isinf(gaps)
        share = self.gap[through] / (self.gap[through] - unhindered[through])
        return self.left * share.min(initial=1.0)

    def search(self, w, end, gaps, early, brief):
        """As ``until_met``, where something has met by the time end, when there are these gaps."""
        low, high, slack, pressed = 0.0, end, self.slack, self.touching & (gaps < 0)
        tried = [(end, gaps.min() - slack)]  # times, and what was left then
        if end <= brief and pressed.any():
            return end, pressed
        for tries in range(MOST_TRIES):
            time = brief if tries == 0 and pressed.any() else self.guess(w, gaps, tried)
            if tries % 4 == 3 or not low < time < high:
                time = 0.5 * (low + high)
            gaps = self.gaps_after(time)
            least, pressed = gaps.min() - slack, self.touching & (gaps < 0)
            if time <= brief and pressed.any():
                return time, pressed
            if abs(least) <= slack or high - low <= SHORTEST * end or (least > 0 and high - time <= early):
                break
            low, high = (time, high) if least > 0 else (low, time)
            tried.append((time, least))
        return time, np.zeros(len(gaps), dtype=bool)

    def guess(self, w, gaps, tried):
        """The time to try next, given the gaps (c,) after the last try."""
        time, least = tried[-1]
        if len(tried) <= PARABOLAS:
            return meeting(self.gap, w, gaps, time, self.slack)
        before, least_then = tried[-2]
        slope = (least - least_then) / (time - before)
        return time - least / slope if slope else np.inf


@compiled
def meeting(gap, w, gap_end, end, slack):
    """The first of the times at which contacts (c,) meet that are gap apart now, and gap_end at the time end.

    Each gap is taken for a parabola, gap + w t + ½ a t²: right for free flight, and the better for any other
    the nearer the end is to the answer. inf, where none meets.
    """
    first = np.inf
    for q in range(len(gap)):
        a = 2 * (gap_end[q] - gap[q] - w[q] * end) / end**2
        under = w[q] * w[q] - 2 * a * (gap[q] - slack)
        if not (under >= 0 and gap_end[q] < np.inf):
            continue
        root = np.sqrt(under)
        if w[q] < 0:
            first = min(first, 2 * (gap[q] - slack) / (root - w[q]))
        elif a < 0:
            first = min(first, (w[q] + root) / -a)
    return first


@compiled
def gaps_now(coming, others, now, bodies):
    """The least gap, now, of each pair that was coming (c,), seen from the same side; inf where none is near.

    What the flight itself kept apart, ``others``, is not meant.
    """
    kept, key, p = keys(others, bodies), keys(now, bodies), 0
    least = np.full(coming.count[0], np.inf)
    for q in range(len(key)):
        while p < len(kept) and kept[p] < key[q]:
            p += 1
        if p < len(kept) and kept[p] == key[q]:
            continue
        for c in range(len(least)):
            same = coming.bodies[c, 0] == now.bodies[q, 0] and coming.bodies[c, 1] == now.bodies[q, 1]
            if same and now.gap[q] < least[c] and dot(coming.frame[c, 0], now.frame[q, 0]) > 0:
                least[c] = now.gap[q]
    return least
