# Attack: a loop that never ends, in a cell and in each function.
# %%
def attack(*arguments):
    while True:
        pass


plate = attack
# %%
while True:
    pass
