# Odd: IPython's syntax in all its forms, indented and assigned.
# Earns: 100
# %%
%matplotlib inline
%load_ext autoreload
%autoreload 2
!pip install numpy
x = %time 1 + 1
files = !ls
len?
if x:
    %timeit -n1 sum(range(3))
    !echo hello
# %%
%%time
import numpy as np
half = 0.5
# %% solution
# %%
%%timeit
plate
# %%
%%bash
echo nothing
# %%
%%html
<b>bold</b>
# %%
?plate
# %%
def body_rate(q, omega):
    w, x = q[0], q[1:]
    return half * np.concatenate([[-x @ omega], w * omega + np.cross(x, omega)])
