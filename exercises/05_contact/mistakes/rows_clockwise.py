# Mistake: the tangent is n turned clockwise.
# Loses: rows
# Says: rows: The tangent's sign
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def rows(centre, radius, a):
    size, _, n = gap(centre, radius, a)
    r, t = -(radius + size / 2) * n, np.array([n[1], -n[0]])
    return np.array([[*e, r[0] * e[1] - r[1] * e[0]] for e in (n, t)])
