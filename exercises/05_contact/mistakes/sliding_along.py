# Mistake: the friction is along the sliding.
# Loses: sliding
# Says: sliding: It must be against the sliding
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def sliding(w, mu, normal):
    size = np.linalg.norm(mu * w)
    return normal * mu**2 * w / size if size > 0 else np.zeros(2)
