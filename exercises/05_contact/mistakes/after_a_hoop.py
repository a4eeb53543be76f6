# Mistake: the inertia is a hoop's.
# Loses: after, roll
# Says: after: A disc has I = ½ m r²
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def after(centre, radius, a, u, mass, mu, dt):
    size = gap(centre, radius, a)[0]
    J = rows(centre, radius, a)
    M = np.diag([mass, mass, mass * radius**2])
    free = u + dt * np.array([0, -G, 0])
    A, b = J @ np.linalg.inv(M) @ J.T, J @ free
    normal = max(0, -(b[0] + size / dt) / A[0, 0])
    along = np.clip(-b[1] / A[1, 1], -mu * normal, mu * normal)
    return free + np.linalg.solve(M, J.T @ [normal, along])
