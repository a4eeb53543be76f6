# Mistake: the factor one half is forgotten.
# Loses: body_rate
# Says: body_rate: factor ½ is missing
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def body_rate(q, omega):
    w, x = q[0], q[1:]
    return np.concatenate([[-x @ omega], w * omega + np.cross(x, omega)])
