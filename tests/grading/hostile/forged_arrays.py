# Attack: replies whose shape and data do not fit, types that do not exist, pickles.
# %%
import json
import os

FORGED = [
    {"array": "AAAA", "type": "O", "shape": [1]},
    {"array": "", "type": "f8", "shape": [-1, 0]},
    {"array": "gASVAAA=", "type": "f8", "shape": [1] * 60},
    {"sparse": [1e308, 1], "row": None, "column": True, "value": {"word": "x"}},
    {"sparse": [3, 1], "row": {"tuple": [0, 99]}, "column": {"tuple": [0, -5]}, "value": {"tuple": [1.0, 1.0]}},
    {"given": "__class__", "parameters": {"dict": []}},
    {"student": "__import__"},
    {"float": "1e400"},
    {"float": ["nan"]},
    {"tuple": {"a": 1}},
    {"dict": [[["a"], 1], [1]]},
    {"word": ["passed"] * 9},
    [[]],
    "passed",
    {"__reduce__": "os.system"},
]


def attack(*arguments):
    replies = [{"value": item} for item in FORGED] + [{"error": 1}, {"error": {"kind": {}, "message": [], "lines": 7}}]
    for start in range(12):
        text = json.dumps({"replies": (replies[start:] + replies)[: 3 + start]})
        os.write(4, text.encode() + b"\n")
    return 0.0


plate = body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
