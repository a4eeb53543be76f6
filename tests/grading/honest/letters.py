# Odd: Greek letters, emoji, tabs, carriage returns in text, a very long line.
# Earns: 100
# %% solution
# %%
def body_rate(q, Ω):
	"""½ q Ω — 🙂"""
	w, x⃗ = q[0], q[1:] if True else None
# %%
def body_rate(q, Ω, ½=None):
    return None
# %%
def body_rate(q, Ω):
    λ, ξ = q[0], q[1:]
    return 0.5 * np.concatenate([[-ξ @ Ω], λ * Ω + np.cross(ξ, Ω)])


long = "é🙂" * 20_000
print(long)
