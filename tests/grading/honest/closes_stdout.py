# Odd: closes and replaces the output.
# Earns: 100
# %%
import io
import sys

sys.stdout.close()
# %%
print("still there")
marker = 1
# %%
sys.stdout = io.StringIO()
sys.stderr = None
# %% solution
# %%
assert marker == 1
print("x" * 10**6)
