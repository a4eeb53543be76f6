# Odd: waits for a person.
# Earns: 100
# %%
name = input("Your name: ")
# %%
help(len)
# %% solution
# %%
exit()
# %%
quit
