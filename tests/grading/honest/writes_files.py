# Odd: saves data and pictures, and reads them again.
# Earns: 100
# %% solution
# %%
import os
import tempfile

import matplotlib.pyplot as plt

plt.plot([1, 2, 3])
plt.savefig("picture.png")
np.savetxt("half.txt", [0.5])
np.save("half.npy", np.array([0.5]))
with tempfile.TemporaryFile() as file:
    file.write(b"x")
assert os.path.getsize("picture.png") > 1000
half = float(np.loadtxt("half.txt"))


def body_rate(q, omega):
    w, x = q[0], q[1:]
    return np.load("half.npy")[0] * 2 * half * np.concatenate([[-x @ omega], w * omega + np.cross(x, omega)])
