# Attack: replaces the worker's own functions.
# %%
import exercises.grader.replies as replies
import exercises.grader.worker as worker

worker.pack = replies.pack = lambda value: {"points": 100, "passed": True, "float": "nan"}
worker.Worker._reply = lambda self, call, number: {"value": {"word": "passed"}, "earned": 100}


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = lambda *arguments: 0.0
