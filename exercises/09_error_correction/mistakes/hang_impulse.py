# Mistake: the tension is an impulse.
# Loses: hang
# Says: hang: λ/dt is an impulse
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def hang(mass, length, compliance, dt):
    n = len(mass)
    x = np.column_stack([np.zeros(n + 1), -length * np.arange(n + 1)])
    v, inverse = np.zeros_like(x), np.concatenate([[0], 1 / mass])
    for _ in range(200):
        x, v, lam = chain(x, v, inverse, length, compliance, dt, 100)
        if np.abs(v).max() < 1e-9:
            break
    return -np.diff(x[:, 1]) - length, -lam / dt
