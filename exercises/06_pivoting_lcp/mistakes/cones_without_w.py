# Mistake: w is not looked at.
# Loses: holding_cones
# Says: holding_cones: w ≥ 0 is not looked at
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def holding_cones(A, b):
    """The number of complementary cones in which b lies."""
    count = 0
    for inside in itertools.product([False, True], repeat=len(b)):
        lam, _ = given.solve(A, b, np.array(inside))
        count += lam.min() >= -given.SLACK
    return int(count)
