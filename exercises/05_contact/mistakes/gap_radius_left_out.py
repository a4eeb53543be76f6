# Mistake: the radius is not taken off.
# Loses: gap, rows, after, roll
# Says: gap: The radius is not taken off
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def gap(centre, radius, a):
    """The nearest of the real roots of the cubic."""
    if a == 0:
        x = centre[0]
    else:
        roots = np.roots([2 * a**2, 0, 1 - 2 * a * centre[1], -centre[0]])
        roots = roots[np.abs(roots.imag) < 1e-7].real
        x = roots[np.argmin((roots - centre[0]) ** 2 + (a * roots**2 - centre[1]) ** 2)]
    point = np.array([x, a * x**2])
    normal = np.array([-2 * a * x, 1]) / np.hypot(2 * a * x, 1)
    return (centre - point) @ normal, point, normal
