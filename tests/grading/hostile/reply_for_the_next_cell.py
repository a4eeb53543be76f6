# Attack: tells the grader that the cells to come have run, and answers before it is asked.
# %%
import json
import os

for cell in range(40):
    os.write(4, json.dumps({"done": cell, "error": None}).encode() + b"\n")
os.write(4, b'{"replies": []}\n')
os._exit(0)
