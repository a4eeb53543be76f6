# Mistake: the choice with no λ at all is left out.
# Loses: holding_cones
# Says: holding_cones: is left out
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def holding_cones(A, b):
    """The number of complementary cones in which b lies."""
    count = 0
    for inside in itertools.product([False, True], repeat=len(b)):
        lam, w = given.solve(A, b, np.array(inside))
        count += any(inside) and min(lam.min(), w.min()) >= -given.SLACK
    return int(count)
