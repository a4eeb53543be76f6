# Mistake: nothing is done about 0/0 at the kink.
# Loses: slopes
# Says: slopes: comes of 0/0
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def slopes(a, b, tau):
    with np.errstate(all="ignore"):
        size = np.hypot(a, b)
        both = (a > 0) & (b > 0)
        return (
            tau * (1 - a / size) + (1 - tau) * np.where(both, b, 0),
            tau * (1 - b / size) + (1 - tau) * np.where(both, a, 0),
        )
