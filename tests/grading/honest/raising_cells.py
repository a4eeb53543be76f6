# Odd: cells that raise, before, between and after; one with a slip of syntax.
# Earns: 100
# %%
1 / 0
# %%
this is no Python
# %% solution
# %%
plate([], [], 1.0)
# %%
undefined_name
# %%
raise SystemExit
# %%
assert False, "this is still open"
