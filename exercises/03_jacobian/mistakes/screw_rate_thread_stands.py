# Mistake: the axis of the thread is taken not to turn.
# Loses: screw_rate
# Says: screw_rate: The thread's own part is missing
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
whole = screw_rate


def screw_rate(axis, arm_i, arm_j, gap, pitch, u):
    return whole(axis, arm_i, arm_j, gap, 0.0, u)
