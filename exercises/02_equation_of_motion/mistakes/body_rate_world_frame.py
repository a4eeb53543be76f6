# Mistake: the angular velocity is taken as one in the world's frame.
# Loses: body_rate
# Says: body_rate: stands on the right
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def body_rate(q, omega):
    w, x = q[0], q[1:]
    return 0.5 * np.concatenate([[-omega @ x], w * omega + np.cross(omega, x)])
