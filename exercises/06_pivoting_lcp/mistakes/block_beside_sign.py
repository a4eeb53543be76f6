# Mistake: the sign beside the inverse is wrong.
# Loses: block_pivot
# Says: block_pivot: sign is wrong beside the inverse
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def block_pivot(T, q, rows):
    """The principal pivot of several rows at once."""
    a, o = rows, np.setdiff1d(np.arange(len(q)), rows)
    new_T, new_q, inverse = np.empty_like(T), np.empty_like(q), np.linalg.inv(T[np.ix_(a, a)])
    new_T[np.ix_(a, a)] = inverse
    new_T[np.ix_(a, o)] = inverse @ T[np.ix_(a, o)]
    new_T[np.ix_(o, a)] = T[np.ix_(o, a)] @ inverse
    new_T[np.ix_(o, o)] = T[np.ix_(o, o)] + T[np.ix_(o, a)] @ inverse @ T[np.ix_(a, o)]
    new_q[a] = -inverse @ q[a]
    new_q[o] = q[o] - T[np.ix_(o, a)] @ inverse @ q[a]
    return new_T, new_q
