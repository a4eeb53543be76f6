# Attack: its own import hooks, path entries, audit hooks, tracing and profiling.
# %%
import sys
import threading

sys.addaudithook(lambda *arguments: None)
sys.settrace(lambda *arguments: None)
sys.setprofile(lambda frame, event, argument: frame.f_locals.clear())
threading.setprofile(lambda *arguments: None)
sys.path_hooks.insert(0, lambda path: 1 / 0)
sys.meta_path.insert(0, type("Hook", (), {"find_spec": staticmethod(lambda *arguments: None)}))
sys.modules["exercises.grader.judges"] = sys.modules["numpy"] = None


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = lambda *arguments: 0.0
