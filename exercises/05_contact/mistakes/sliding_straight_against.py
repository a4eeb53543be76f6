# Mistake: the friction is straight against the sliding.
# Loses: sliding
# Says: sliding: It is straight against w
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def sliding(w, mu, normal):
    size = np.linalg.norm(w / mu)
    return -normal * w / size if size > 0 else np.zeros(2)
