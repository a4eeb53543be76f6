# Mistake: b without J̇u.
# Loses: embed, swing
# Says: embed: J̇u is left out of b


# %%
def embed(J, mass, force, rate):
    B = J / mass
    return B @ J.T, B @ force
