"""Which submissions share most of their code, the starter's taken away. A list, never an accusation.

The numbers that stand for a notebook's code were made in the sandbox (fingerprint.py); here they are
compared.
"""

import itertools
from collections import Counter, defaultdict

import numpy as np
import scipy.sparse

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
    """By the product of a matrix with its transpose: a row a submission, a column a number, 1 where it has
    it."""
    ones = [one for one, numbers in numbers_of.items() if len(numbers) >= LEAST]
    sizes = np.array([len(numbers_of[one]) for one in ones])
    if len(ones) < 2:
        return
    numbers = np.concatenate([np.fromiter(numbers_of[one], dtype="i8") for one in ones])
    columns = np.unique(numbers, return_inverse=True)[1]
    has = scipy.sparse.csr_array(
        (np.ones(len(columns), int), (np.repeat(np.arange(len(ones)), sizes), columns))
    )
    shared = (has @ has.T).toarray() / np.minimum.outer(sizes, sizes)
    for first, second in np.argwhere(np.triu(shared >= SHARE, 1)):
        yield float(shared[first, second]), ones[first], ones[second]
