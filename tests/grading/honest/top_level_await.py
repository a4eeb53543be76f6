# Odd: await outside of a function, twice, with a task.
# Earns: 100
# %%
import asyncio

await asyncio.sleep(0)
# %% solution
# %%
async def later():
    await asyncio.sleep(0.001)
    return 0.5


half = await later()
results = await asyncio.gather(later(), later())


def body_rate(q, omega, inner=body_rate):
    return 2 * half * inner(q, omega)
