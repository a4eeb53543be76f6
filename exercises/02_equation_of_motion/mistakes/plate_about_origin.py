# Mistake: the moment is about the origin of the coordinates, not about the centre of mass.
# Loses: plate
# Says: plate: about the origin of the coordinates
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def plate(outline, holes, density):
    parts = [(1, *given.polygon(outline)), *((-1, *given.polygon(hole)) for hole in holes)]
    area = sum(sign * part for sign, part, _, _ in parts)
    centre = sum(sign * part * middle for sign, part, middle, _ in parts) / area
    inertia = sum(sign * (second + part * middle @ middle) for sign, part, middle, second in parts)
    return density * area, centre, density * inertia
