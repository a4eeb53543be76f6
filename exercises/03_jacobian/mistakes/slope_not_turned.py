# Mistake: only the positions are moved.
# Loses: slope
# Says: slope: The bodies move but don't turn


# %%
def slope(phi, pose, u, h):
    moved = []
    for t in (h, -h):
        there = pose.copy()
        there[:3] += t * u[:3]
        there[7:10] += t * u[6:9]
        moved.append(there)
    return (phi(moved[0]) - phi(moved[1])) / (2 * h)
