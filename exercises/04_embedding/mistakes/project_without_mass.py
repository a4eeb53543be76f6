# Mistake: both masses move alike.
# Loses: project
# Says: project: Along M⁻¹Jᵀ a light one moves more
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def project(x, mass, pulleys, length):
    for _ in range(30):
        phi = np.linalg.norm(x[:2] - pulleys[:2]) + np.linalg.norm(x[2:] - pulleys[2:]) - length
        J, _ = rope(x, np.zeros(4), pulleys)
        x = x - J * phi / (J @ J)
    return x
