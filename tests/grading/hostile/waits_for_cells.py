# Attack: many cells that each take as long as they may.
# %%
import time
# %%
time.sleep(9)
# %%
time.sleep(9)
# %%
time.sleep(9)
# %%
time.sleep(9)
