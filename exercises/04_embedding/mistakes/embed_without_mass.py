# Mistake: A without the masses.
# Loses: embed, swing
# Says: embed: the masses are left out


# %%
def embed(J, mass, force, rate):
    return J @ J.T, J @ (force / mass) + rate
