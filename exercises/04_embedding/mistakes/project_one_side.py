# Mistake: only the first mass is moved.
# Loses: project
# Says: project: the rope pulls at both
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def project(x, mass, pulleys, length):
    there = np.array([1, 1, 0, 0])
    for _ in range(30):
        phi = np.linalg.norm(x[:2] - pulleys[:2]) + np.linalg.norm(x[2:] - pulleys[2:]) - length
        J, _ = rope(x, np.zeros(4), pulleys)
        x = x - there * J * phi / (J @ (there * J))
    return x
