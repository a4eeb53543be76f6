# Mistake: J̇u with the wrong sign.
# Loses: rope, swing
# Says: rope: J̇u has the wrong sign
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def rope(x, u, pulleys):
    J, rate = np.zeros(4), 0.0
    for side in (slice(0, 2), slice(2, 4)):
        offset = x[side] - pulleys[side]
        r = np.linalg.norm(offset)
        n = offset / r
        J[side] = n
        rate -= (u[side] @ u[side] - (n @ u[side]) ** 2) / r
    return J, rate
