# Mistake: a root of a negative number is taken for 0.
# Loses: chain_rate
# Says: chain_rate: η is complex
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def chain_rate(n, omega, r):
    square = np.cos((2 * np.arange(1, n + 1) - 1) * np.pi / (2 * n)) ** 2
    half = omega - 1 - omega * r * square / 2
    root = np.sqrt(np.maximum(0, half**2 - (omega - 1) ** 2 + omega * (omega - r) * square))
    return float(np.abs(np.concatenate([-half + root, -half - root])).max())
