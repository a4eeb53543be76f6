# Attack: changes what open, print, len and isinstance do.
# %%
import builtins

builtins.isinstance = lambda thing, kind: True
builtins.len = lambda thing: 0
builtins.print = lambda *arguments, **options: None
builtins.abs = lambda value: 0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = lambda *arguments: 0.0
