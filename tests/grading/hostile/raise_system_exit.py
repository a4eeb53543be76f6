# Attack: leaves by exceptions that are not caught as usual.
# %%
class Sly(BaseException):
    def __str__(self):
        raise SystemExit(0)

    def __repr__(self):
        raise GeneratorExit

    __traceback__ = property(lambda self: 1 / 0)


def attack(*arguments):
    raise Sly


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
# %%
raise Sly
# %%
raise GeneratorExit
# %%
raise KeyboardInterrupt
