# Attack: looks for checks, verdicts and recordings among all objects of the process.
# %%
import gc


def attack(*arguments):
    for thing in gc.get_objects():
        kind = type(thing)
        if kind.__module__.startswith("exercises.") and kind.__name__ in ("Check", "Verdict", "Case", "EngineOracle"):
            raise RuntimeError("BREACH " + repr(thing))
        if kind is dict and ("oracle" in thing or "expected" in thing and "tolerance" in thing):
            raise RuntimeError("BREACH a dict")
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
