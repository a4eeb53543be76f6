# Odd: a cell that defines what is right, then raises; what stands behind it in the cell is lost.
# Earns: 90
# %% solution
# %%
def body_rate(q, omega):
    return None


print(undefined_name)


def body_rate(q, omega):
    w, x = q[0], q[1:]
    return 0.5 * np.concatenate([[-x @ omega], w * omega + np.cross(x, omega)])
