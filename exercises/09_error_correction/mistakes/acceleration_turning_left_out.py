# Mistake: J̇u is left out.
# Loses: acceleration, swing
# Says: acceleration: J̇u is left out
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def acceleration(x, v, length, alpha, beta):
    r = np.linalg.norm(x)
    n = x / r
    phi, rate = r - length, n @ v
    lam = -2 * alpha * rate - beta**2 * phi - n @ given.GRAVITY
    return given.GRAVITY + lam * n
