# Mistake: the point is straight below the centre.
# Loses: gap, rows, after, roll
# Says: gap: The point is straight below the centre
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def gap(centre, radius, a):
    x = centre[0]
    point = np.array([x, a * x**2])
    normal = np.array([-2 * a * x, 1]) / np.hypot(2 * a * x, 1)
    return (centre - point) @ normal - radius, point, normal
