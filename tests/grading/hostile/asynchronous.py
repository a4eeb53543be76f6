# Attack: coroutines, generators and tasks in place of answers.
# %%
import asyncio


async def attack(*arguments):
    await asyncio.sleep(10**6)


def generator(*arguments):
    while True:
        yield 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
plate = body_rate = generator
# %%
await asyncio.sleep(10**6)
