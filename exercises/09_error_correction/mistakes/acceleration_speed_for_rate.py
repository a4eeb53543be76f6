# Mistake: the speed stands for the rate of the gap.
# Loses: acceleration, swing
# Says: acceleration: φ̇ is n·v
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def acceleration(x, v, length, alpha, beta):
    r = np.linalg.norm(x)
    n = x / r
    phi, rate = r - length, n @ v
    turning = (v @ v - rate**2) / r
    lam = -2 * alpha * np.linalg.norm(v) - beta**2 * phi - turning - n @ given.GRAVITY
    return given.GRAVITY + lam * n
