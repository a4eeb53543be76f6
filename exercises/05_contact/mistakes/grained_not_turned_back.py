# Mistake: the friction stays in the grain's frame.
# Loses: grained
# Says: grained: The answer is still in the grain's frame
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def grained(pull, mu, normal, angle):
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[c, -s], [s, c]])
    return holding(R.T @ pull, mu, normal)
