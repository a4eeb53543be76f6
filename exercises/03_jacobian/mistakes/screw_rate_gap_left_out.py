# Mistake: the gap is left out of the second derivative.
# Loses: screw_rate
# Says: screw_rate: The gap is left out
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
whole = screw_rate


def screw_rate(axis, arm_i, arm_j, gap, pitch, u):
    return whole(axis, arm_i, arm_j, 0.0, pitch, u)
