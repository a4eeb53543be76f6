# Mistake: only the first wrong row is pivoted.
# Loses: all_at_once
# Says: all_at_once: Only the first wrong row
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def all_at_once(A, b):
    """Whether it is solved, the rounds, and λ of the choice where it stops."""
    inside, seen, rounds = np.zeros(len(b), dtype=bool), set(), 0
    y = basic(A, b, inside)
    while y.min() < -given.SLACK and inside.tobytes() not in seen:
        seen.add(inside.tobytes())
        inside = inside ^ (np.arange(len(y)) == np.argmax(y < -given.SLACK))
        rounds += 1
        y = basic(A, b, inside)
    return "cycle" if y.min() < -given.SLACK else "solved", rounds, np.where(inside, y, 0.0)
