# Mistake: it is compared with the last choice only.
# Loses: all_at_once
# Says: all_at_once: stops too early or too late
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def all_at_once(A, b):
    """Whether it is solved, the rounds, and λ of the choice where it stops."""
    inside, seen, rounds = np.zeros(len(b), dtype=bool), set(), 0
    y = basic(A, b, inside)
    while y.min() < -given.SLACK and rounds < 50:
        seen.add(inside.tobytes())
        inside = inside ^ (y < -given.SLACK)
        rounds += 1
        y = basic(A, b, inside)
    return "cycle" if y.min() < -given.SLACK else "solved", rounds, np.where(inside, y, 0.0)
