# Mistake: the pull is turned the wrong way.
# Loses: grained
# Says: grained: The pull is turned the wrong way
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def grained(pull, mu, normal, angle):
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[c, -s], [s, c]])
    return R.T @ holding(R @ pull, mu, normal)
