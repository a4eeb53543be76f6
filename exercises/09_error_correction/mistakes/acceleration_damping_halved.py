# Mistake: the damping lacks its 2.
# Loses: acceleration, swing
# Says: acceleration: The damping lacks its factor 2
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def acceleration(x, v, length, alpha, beta):
    r = np.linalg.norm(x)
    n = x / r
    phi, rate = r - length, n @ v
    turning = (v @ v - rate**2) / r
    lam = -alpha * rate - beta**2 * phi - turning - n @ given.GRAVITY
    return given.GRAVITY + lam * n
