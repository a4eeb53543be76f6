"""Which submissions share most of their code, the starter's taken away. A list, never an accusation.

The numbers that stand for a notebook's code were made in the sandbox (fingerprint.py); here they are
compared.
"""

import itertools
from collections import Counter, defaultdict

SHARE = 0.8  # of the smaller one's numbers that must be in both
LEAST = 60  # numbers below which everyone's solution looks alike
COMMON, FEW = (
    0.2,
    20,
)  # what more than this share of the class, and than so many, wrote is what the task suggests
MOST_PAIRS = 500


def pairs(submissions, store):
    """[(share, submission, submission)], the most alike first."""
    found = []
    for unit in sorted({one.unit for one in submissions}):
        of_unit = {}
        for one in submissions:
            result = store.read(one) if one.unit == unit and (one.path or one.refused) else None
            numbers = ((result or {}).get("fingerprint") or {}).get("numbers", ())
            if numbers:
                of_unit[one] = set(numbers)
        of_pair = {(one, other): share for share, one, other in _pairs(_without_common(of_unit))}
        of_pair.update(dict.fromkeys(_same(of_unit), 1.0))
        found += [(share, *pair) for pair, share in of_pair.items()]
    return sorted(found, key=lambda pair: (-pair[0], pair[1].key, pair[2].key))[:MOST_PAIRS]


def _same(numbers_of):
    """Neighbours in each group of equal ones, however many wrote the same."""
    groups = defaultdict(list)
    for one, numbers in numbers_of.items():
        if len(numbers) >= LEAST:
            groups[frozenset(numbers)].append(one)
    for group in groups.values():
        yield from itertools.pairwise(group)


def _without_common(numbers_of):
    """Without what many wrote, where the class is large enough to tell."""
    counts = Counter(number for numbers in numbers_of.values() for number in numbers)
    most = max(FEW, COMMON * len(numbers_of))
    return {
        one: {number for number in numbers if counts[number] <= most} for one, numbers in numbers_of.items()
    }


def _pairs(numbers_of):
    holders, shared = defaultdict(list), Counter()
    for one, numbers in numbers_of.items():
        if len(numbers) >= LEAST:
            for number in numbers:
                shared.update((other, one) for other in holders[number])
                holders[number].append(one)
    for (one, other), count in shared.items():
        share = count / min(len(numbers_of[one]), len(numbers_of[other]))
        if share >= SHARE:
            yield share, one, other
