"""For all tests: one thread for linear algebra, and pictures that need no screen."""

import os

# Before NumPy is first imported: threads would make timings depend on what else the machine does.
for name in ("OMP", "OPENBLAS", "MKL", "BLIS", "VECLIB_MAXIMUM"):
    os.environ.setdefault(name + "_NUM_THREADS", "1")
os.environ.setdefault("MPLBACKEND", "Agg")
