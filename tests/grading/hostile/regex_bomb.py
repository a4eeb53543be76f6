# Attack: a pattern that takes for ever, holding the interpreter's lock.
# %%
import re


def plate(*arguments):
    return re.match(r"(a+)+$", "a" * 60 + "b")
