# Odd: imports what is not there, without needing it; asks IPython for things to show.
# Earns: 100
# %%
import pandas as pd
import pymunk
import reference
import sympy.physics as physics
from IPython import get_ipython
from IPython.display import HTML, clear_output, display
from reference import simulate
from tqdm import tqdm

get_ipython().run_line_magic("matplotlib", "inline")
display(HTML("<b>x</b>"))
clear_output(wait=True)
try:
    import seaborn
    seaborn.set_theme()
except ImportError:
    pass
import matplotlib.pyplot as plt

plt.figure()
# %% solution
