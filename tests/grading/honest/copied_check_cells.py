# Odd: check cells copied, and one that holds real work beside the call.
# Earns: 100
# %% solution
# %%
check("plate"); check("body_rate")
check()


def body_rate(q, omega):
    w, x = q[0], q[1:]
    return 0.5 * np.concatenate([[-x @ omega], w * omega + np.cross(x, omega)])


assert check("body_rate") is None
# %%
given, check = load(2)
check("no such check")
