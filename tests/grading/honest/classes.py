# Odd: classes, dataclasses, enums, pickles of its own things, and reading its own source.
# Earns: 100
# %%
import copy
import enum
import inspect
import pickle
from dataclasses import dataclass
# %% solution
# %%
@dataclass
class Body:
    mass: float
    kind: "Kind" = None


class Kind(enum.Enum):
    FREE = 1


assert pickle.loads(pickle.dumps(Body(1.0, Kind.FREE))) == Body(1.0, Kind.FREE)
assert "mass: float" in inspect.getsource(Body) and "numpy" not in inspect.getsource(plate)
copy.deepcopy(Body(2.0))
if __name__ == "__main__":
    ready = True
assert ready
