# Attack: fills the disk, by one large file and by many.
# %%
import os


def attack(*arguments):
    wrote = 0
    for number in range(10_000):
        try:
            with open(f"f{number}", "wb") as file:
                for _ in range(64):
                    wrote += file.write(b"x" * (1 << 20))
        except OSError:
            break
    if wrote > 1 << 30:
        raise RuntimeError("BREACH wrote a gigabyte")
    os.truncate("f0", 1 << 50)
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
