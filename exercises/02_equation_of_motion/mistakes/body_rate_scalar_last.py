# Mistake: the quaternion is read as (x, y, z, w).
# Loses: body_rate
# Says: body_rate: q = (w, x, y, z)
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def body_rate(q, omega):
    w, x = q[3], q[:3]
    return 0.5 * np.concatenate([w * omega + np.cross(x, omega), [-x @ omega]])
