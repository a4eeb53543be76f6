# Mistake: the points are not accelerated by their bodies' turning.
# Loses: screw_rate
# Says: screw_rate: The centripetal terms ω × (ω × r) are missing
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
whole = screw_rate


def screw_rate(axis, arm_i, arm_j, gap, pitch, u):
    inward = [np.cross(omega, np.cross(omega, arm)) for omega, arm in ((u[3:6], arm_i), (u[9:], arm_j))]
    return whole(axis, arm_i, arm_j, gap, pitch, u) - axis @ (inward[1] - inward[0])
