# Mistake: μ is not squared.
# Loses: sliding
# Says: sliding: μ_1 and μ_2 stand in the numerator squared
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def sliding(w, mu, normal):
    size = np.linalg.norm(mu * w)
    return -normal * mu * w / size if size > 0 else np.zeros(2)
