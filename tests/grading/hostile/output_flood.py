# Attack: prints without end.
# %%
import sys


def attack(*arguments):
    for _ in range(10**7):
        print("x" * 100_000)


plate = attack
# %%
for _ in range(2000):
    print("y" * 100_000)
    sys.stderr.write("z" * 100_000)
