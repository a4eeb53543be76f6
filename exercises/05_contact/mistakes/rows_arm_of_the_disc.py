# Mistake: the arm is the disc's radius, whatever the gap.
# Loses: rows
# Says: rows: The arm ends on the disc
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def rows(centre, radius, a):
    _, _, n = gap(centre, radius, a)
    r, t = -radius * n, np.array([-n[1], n[0]])
    return np.array([[*e, r[0] * e[1] - r[1] * e[0]] for e in (n, t)])
