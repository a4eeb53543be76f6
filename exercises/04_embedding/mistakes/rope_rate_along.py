# Mistake: the velocity along the rope counts as turning.
# Loses: rope, swing
# Says: rope: The part of u along the rope
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def rope(x, u, pulleys):
    J, rate = np.zeros(4), 0.0
    for side in (slice(0, 2), slice(2, 4)):
        offset = x[side] - pulleys[side]
        r = np.linalg.norm(offset)
        J[side] = offset / r
        rate += u[side] @ u[side] / r
    return J, rate
