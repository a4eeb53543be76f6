# Mistake: the chain is taken as held at both ends.
# Loses: chain_rate
# Says: chain_rate: On the ground it is free
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def chain_rate(n, omega, r):
    square = np.cos(np.arange(1, n + 1) * np.pi / (n + 1)) ** 2
    half = omega - 1 - omega * r * square / 2
    root = np.sqrt(half**2 - (omega - 1) ** 2 + omega * (omega - r) * square + 0j)
    return float(np.abs(np.concatenate([-half + root, -half - root])).max())
