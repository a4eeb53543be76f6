"""Helpers of the exercise of unit 05, contact (slides S10–S12)."""

import numpy as np

G = 9.81  # m/s², along −y


def road(a, x):
    """The height of the road, a parabola with its lowest point at the origin, m. a: 1/m."""
    return a * x**2


def show_gap(gap):
    """Draws a road, three discs, and where ``gap`` says that they are nearest to it."""
    centres = np.array([(-0.9, 1.5), (0.3, 0.55), (1.1, 0.75)])
    found = [gap(centre, 0.3, 0.8) for centre in centres]
    if any(answer is None or len(answer) != 3 for answer in found):
        print("The picture comes once gap passes its check.")
        return
    _draw_gap(centres, found)


def _draw_gap(centres, found):
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(figsize=(5, 3.4))
    x = np.linspace(-1.5, 1.5, 100)
    axes.plot(x, road(0.8, x), color="0.3")
    for centre, (size, point, normal) in zip(centres, found, strict=True):
        axes.add_patch(plt.Circle(centre, 0.3, fill=False))
        axes.plot(*point, "o")
        axes.annotate("", point + 0.4 * np.asarray(normal), point, arrowprops={"arrowstyle": "->"})
        axes.annotate(f"{size:.2f} m", centre, ha="center")
    axes.set(aspect="equal", xlabel="x (m)", ylabel="y (m)")
    plt.show()
