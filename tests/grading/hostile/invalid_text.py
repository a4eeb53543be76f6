# Attack: bytes that are no UTF-8, lone surrogates, control characters.
# %%
import os

first = "x\ud800"
os.write(4, b'{"done": 1, "error": {"kind": "\\ud800", "message": "\\u001b[31m\xff", "lines": ["\\udfff", 3]}}\n')


def plate(*arguments):
    raise ValueError("\ud800 \x00 \x1b]0;title\x07 \u202e")


def attack(*arguments):
    os.write(4, b'\xff\xfe{"replies": [\x00]}\n')


body_rate = gyrostat_rate = air_force = kutta_step = march = flip_time = swing = attack
