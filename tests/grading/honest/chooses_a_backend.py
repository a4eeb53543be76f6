# Odd: asks for a window to draw in.
# Earns: 100
# %%
import matplotlib

matplotlib.use("TkAgg")
import matplotlib.pyplot as plt

plt.switch_backend("QtAgg")
plt.ion()
fig, ax = plt.subplots(layout="constrained")
ax.plot([0, 1], [0, 1], label="$\\omega_1$")
ax.legend()
plt.show()
fig.canvas.draw()
# %% solution
