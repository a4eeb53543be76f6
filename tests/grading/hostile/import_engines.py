# Attack: lets the engines that judge do the work.
# %%
import sys

sys.meta_path[:] = [finder for finder in sys.meta_path if "absent" not in type(finder).__module__]
for name in list(sys.modules):
    if name.split(".")[0] in ("pymunk", "pybullet", "reference"):
        del sys.modules[name]


def attack(*arguments):
    try:
        import pymunk
    except ImportError:
        return 0.0
    raise RuntimeError("BREACH " + pymunk.version)


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
