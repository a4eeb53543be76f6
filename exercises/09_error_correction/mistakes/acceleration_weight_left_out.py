# Mistake: gravity along the rod is not made up for.
# Loses: acceleration, swing
# Says: acceleration: Gravity's pull along the rod is still there
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def acceleration(x, v, length, alpha, beta):
    r = np.linalg.norm(x)
    n = x / r
    phi, rate = r - length, n @ v
    turning = (v @ v - rate**2) / r
    lam = -2 * alpha * rate - beta**2 * phi - turning
    return given.GRAVITY + lam * n
