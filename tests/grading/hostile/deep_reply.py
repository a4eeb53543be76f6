# Attack: returns tuples nested so deep that reading them may overflow.
# %%
def attack(*arguments):
    value = 0.0
    for _ in range(500):
        value = (value, value)
    deep = []
    for _ in range(100_000):
        deep = [deep]
    return deep


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
