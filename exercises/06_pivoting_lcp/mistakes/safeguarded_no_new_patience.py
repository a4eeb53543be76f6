# Mistake: patience is not given back.
# Loses: safeguarded
# Says: safeguarded: gives back the whole patience
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def safeguarded(A, b, patience):
    """λ and the rounds of pivoting all wrong rows at once, with one alone where that doesn't get better."""
    inside, fewest, left, rounds = np.zeros(len(b), dtype=bool), len(b) + 1, patience, 0
    while True:
        y = basic(A, b, inside)
        wrong = np.flatnonzero(y < -given.SLACK)
        if len(wrong) == 0:
            return np.where(inside, y, 0.0), rounds
        if len(wrong) < fewest:
            fewest = len(wrong)
        elif left > 0:
            left -= 1
        else:
            wrong = wrong[-1:]
        inside[wrong] = ~inside[wrong]
        rounds += 1
