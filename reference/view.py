"""Pictures: errors against the step, series in time, bodies at an instant, and animations that need no network.

Colours are those of Okabe & Ito, which readers with colour vision deficiencies can tell apart; lines differ in their
dashes as well. ``show(figure, alt)`` puts a description in words into the page, where a screen reader finds it.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import base64
import io
from html import escape

import matplotlib.pyplot as plt
import numpy as np
from cycler import cycler
from matplotlib.animation import FuncAnimation
from matplotlib.collections import PolyCollection

from .rotation import over_arrays, rotate, rotate_in_plane
from .shapes import Box, Capsule, Disc, Plane, Point, Polygon, Sphere

BLUE, VERMILLION, GREEN, ORANGE = "#0072B2", "#D55E00", "#009E73", "#E69F00"
PURPLE, SKY, YELLOW, BLACK, GREY = "#CC79A7", "#56B4E9", "#F0E442", "#000000", "#777777"
COLOURS = (BLUE, VERMILLION, GREEN, ORANGE, PURPLE, SKY, BLACK, GREY)
SIDES = (BLUE, SKY, VERMILLION, ORANGE, GREEN, YELLOW)  # of a box: −x, +x, −y, +y, −z, +z
DASHES = ("-", "--", "-.", ":", (0, (5, 1)), (0, (3, 1, 1, 1)), (0, (1, 1)), (0, (8, 2, 1, 2)))


def use_style():
    """Make the look of the course Matplotlib's own, for all figures that follow."""
    plt.rcParams.update({
        "axes.prop_cycle": cycler(color=COLOURS) + cycler(linestyle=DASHES),
        "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False,
        "figure.figsize": (7, 3.2), "figure.dpi": 100, "figure.constrained_layout.use": True, "legend.frameon": False,
    })


class Picture:
    """A figure as a front end shows it: the image with its description ``alt``, and what follows it in ``html``."""

    def __init__(self, png, alt, html=""):
        self.png, self.alt, self.html = png, alt, html

    def _repr_mimebundle_(self, **_):
        data = base64.b64encode(self.png).decode()
        image = f'<img alt="{escape(self.alt)}" src="data:image/png;base64,{data}" style="max-width:100%">'
        return {"text/html": image + self.html, "image/png": data, "text/plain": self.alt}


def show(figure, alt):
    """Close the figure and return it as a Picture; ``alt`` says in words what is to be seen."""
    if not isinstance(alt, str) or len(alt.split()) < 4:
        raise ValueError(f"alt must say in words what the figure shows, but is {alt!r}")
    file = io.BytesIO()
    figure.savefig(file, format="png", metadata={"Software": None})  # no version: the same picture, the same bytes
    plt.close(figure)
    return Picture(file.getvalue(), alt)


def plot_convergence(dts, errors, orders=(), axes=None, ylabel="error"):
    """Errors against the time step, both logarithmic: a line a name of the dictionary ``errors``; returns the axes.

    dts: (k,) s; each value of errors: (k,). orders: for each a grey guide of that slope, under the nearest line.
    """
    dts, axes = _positive("dts", dts), axes or plt.subplots()[1]
    if not errors:
        raise ValueError("errors must be a dictionary of at least one name and its errors, but is empty")
    for name, values in errors.items():
        if np.shape(values) != dts.shape:
            raise ValueError(f"errors[{name!r}] must have one error a time step, {len(dts)}, but has {np.shape(values)}")
        axes.loglog(dts, values, marker="o", markersize=4, label=name)
    ends = [np.asarray(values, float)[np.argmax(dts)] for values in errors.values()]
    for order, start in zip(orders, sorted(set(ends), reverse=True), strict=False):
        axes.loglog(dts, 0.4 * start * (dts / dts.max()) ** order, color="grey", linewidth=0.8, linestyle="-")
        axes.annotate(f"slope {order}", (dts.min(), 0.4 * start * (dts.min() / dts.max()) ** order), color="grey")
    axes.set(xlabel="time step h (s)", ylabel=ylabel)
    axes.legend()
    return axes


def plot_series(time, series, ylabel, axes=None, log=False):
    """Quantities against time, a line a name of the dictionary ``series``; a value (T,) or (times, (T,)). Returns axes."""
    axes = axes or plt.subplots()[1]
    for name, values in series.items():
        when, values = values if isinstance(values, tuple) else (time, values)
        if np.shape(when) != np.shape(values):
            raise ValueError(f"series[{name!r}] must have one value a time, {np.shape(when)}, but has {np.shape(values)}")
        (axes.semilogy if log else axes.plot)(when, values, label=name)
    axes.set(xlabel="time (s)", ylabel=ylabel)
    axes.legend()
    return axes


def plot_energy(runs, axes=None):
    """The relative energy error |E(t) − E(0)| / |E(0)| of each run of the dictionary ``runs``; returns the axes."""
    errors = {name: (run.time, np.abs(run.energy() / run.energy()[0] - 1) + 1e-17) for name, run in runs.items()}
    return plot_series(None, errors, "relative energy error", axes, log=True)


def faces(shape, dimension):
    """The polygons (k, d) that bound a shape, in its body's frame, and the colour of each."""
    if isinstance(shape, Box) and dimension == 3:
        square = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
        sides = [(axis, side) for axis in range(3) for side in (-1, 1)]
        corners = [np.insert(square[::side], axis, side, axis=1) for axis, side in sides]
        corners[2:4] = [polygon[::-1] for polygon in corners[2:4]]  # so that all go round anticlockwise from outside
        return [polygon * shape.half_extents for polygon in corners], SIDES
    if isinstance(shape, (Sphere, Capsule)) and dimension == 3:
        return _round_faces(shape.radius, getattr(shape, "half_length", 0))
    turns = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    circle = np.column_stack([np.cos(turns), np.sin(turns)])
    if isinstance(shape, Disc):  # half of it in another colour, so that one sees it turn
        return [shape.radius * circle, shape.radius * circle[:25]], (SKY, BLUE)
    if isinstance(shape, Capsule):
        return [shape.radius * circle + np.outer(circle[:, 1] >= 0, (0, 2 * shape.half_length)) - (0, shape.half_length)], (SKY,)
    if isinstance(shape, Box):
        return [np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * shape.half_extents], (SKY,)
    if isinstance(shape, Polygon):
        return [np.array(shape.vertices)], (SKY,)
    return [], ()  # a Point and a Plane bound nothing


def _round_faces(radius, half_length):
    """A globe of patches, pulled apart at the equator; its quarters have different colours."""
    latitudes, quarters = np.radians([-90, -60, -30, 0, 0, 30, 60, 90]), np.radians(np.arange(0, 361, 30))
    heights = radius * np.sin(latitudes) + half_length * np.repeat((-1, 1), 4)
    rings = [
        np.column_stack([r * np.cos(quarters), r * np.sin(quarters), np.full(13, z)])
        for r, z in zip(radius * np.cos(latitudes), heights, strict=True)
    ]
    patches = [(low[[j, j + 1]], high[[j + 1, j]], j) for low, high in zip(rings, rings[1:], strict=False) for j in range(12)]
    return [np.vstack(patch[:2]) for patch in patches], [(BLUE, SKY)[patch[2] // 3 % 2] for patch in patches]


def _camera(view):
    """Rows: right, up and towards the viewer, for an elevation and an azimuth in degrees."""
    (se, sa), (ce, ca) = np.sin(np.radians(view)), np.cos(np.radians(view))
    return np.array([(-sa, ca, 0), (-se * ca, -se * sa, ce), (ce * ca, ce * sa, se)])


def draw(scene, run, k=-1, axes=None, view=(20, 30), path=False):
    """Draw the bodies as they are at record k of the run; returns the axes.

    view: elevation and azimuth in degrees from which a scene in space is seen, without perspective. path: also the
    way of the centres up to then. In space the axes show metres to the right and up as seen.
    """
    axes = axes or plt.subplots(figsize=(4, 4))[1]
    if not -len(run.time) <= k < len(run.time):
        raise ValueError(f"k must be the number of a record, 0 … {len(run.time) - 1}, but is {k}")
    d, k = scene.dimension, k % len(run.time)
    camera = _camera(view) if d == 3 else np.eye(2)
    seen = run.position @ camera.T
    for i in np.argsort(seen[k, :, -1]) if d == 3 else range(len(scene.bodies)):  # the far ones first
        _draw_body(axes, scene.bodies[i], run.position[k, i], run.orientation[k, i], camera)
        if path:
            axes.plot(seen[: k + 1, i, 0], seen[: k + 1, i, 1], color="grey", linewidth=0.8, linestyle="-", zorder=1)
    for spring in scene.springs:
        ends = [_where(scene, run, k, i, p) @ camera.T for i, p in ((spring.a, spring.point_a), (spring.b, spring.point_b))]
        axes.plot(*np.array(ends)[:, :2].T, color="grey", linewidth=1.5, linestyle=":", zorder=4)
    low, high = _limits(scene, seen)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal", xlabel="x (m)" if d == 2 else "right (m)",
             ylabel="y (m)" if d == 2 else "up (m)", title=f"t = {run.time[k]:.4g} s")
    return axes


def _limits(scene, seen):
    """The lower left and upper right corner of all that a run shows."""
    reach = 1.1 * max([1e-3] + [_radius(body.shape, scene.dimension) for body in scene.bodies])
    return np.nanmin(seen[..., :2], axis=(0, 1)) - reach, np.nanmax(seen[..., :2], axis=(0, 1)) + reach


def _draw_body(axes, body, position, orientation, camera):
    d = len(position)
    turn = over_arrays(rotate) if d == 3 else rotate_in_plane
    if isinstance(body.shape, Point):
        axes.plot(*(camera @ position)[:2], "o", color=BLACK, markersize=5, zorder=5)
    if isinstance(body.shape, Plane) and d == 2:
        axes.axline(position, position + (-body.shape.normal[1], body.shape.normal[0]), color="grey", linestyle="-")
    polygons, colours = faces(body.shape, d)
    seen = [(position + turn(orientation, polygon)) @ camera.T for polygon in polygons]
    front = [d == 2 or _area(polygon) > 0 for polygon in seen]
    axes.add_collection(PolyCollection(
        [polygon[:, :2] for polygon, shown in zip(seen, front, strict=True) if shown],
        facecolors=[colour for colour, shown in zip(colours, front, strict=True) if shown],
        edgecolors="0.25", linewidths=0.6, zorder=3))


def _where(scene, run, k, i, point):
    """Where a point, given in world coordinates at the start, of body i is at record k; of the world, where it was."""
    if i is None:
        return point
    turn, body = over_arrays(rotate) if scene.dimension == 3 else rotate_in_plane, scene.bodies[i]
    back = body.orientation * np.array([1, -1, -1, -1]) if scene.dimension == 3 else -body.orientation
    return run.position[k, i] + turn(run.orientation[k, i], turn(back, point - body.position))


def _area(polygon):
    x, y = polygon[:, 0], polygon[:, 1]
    return np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))


def _radius(shape, dimension):
    return max((np.linalg.norm(polygon, axis=1).max() for polygon in faces(shape, dimension)[0]), default=0)


def key_frames(scene, run, frames=5, view=(20, 30), path=False):
    """A Figure with the bodies at ``frames`` instants, evenly spread over the run, side by side."""
    if not 1 <= frames <= 12:
        raise ValueError(f"frames must be a number from 1 to 12, but is {frames!r}")
    (left, bottom), (right, top) = _limits(scene, run.position @ _camera(view).T if scene.dimension == 3 else run.position)
    height = 0.8 + np.clip(1.6 * (top - bottom) / (right - left), 0.7, 4)
    figure, panels = plt.subplots(1, frames, figsize=(1.9 * frames, height), sharey=True, squeeze=False)
    for axes, k in zip(panels[0], np.linspace(0, len(run.time) - 1, frames).round().astype(int), strict=True):
        draw(scene, run, k, axes, view, path)
        axes.label_outer()
    return figure


def animate(scene, run, alt, frames=40, seconds=4, key=5, view=(20, 30), path=False):
    """A Picture: key frames side by side, with their description, and under them a player that works offline.

    frames: how many pictures the animation has; seconds: how long it plays; key: how many key frames stand above.
    """
    if not isinstance(frames, (int, np.integer)) or frames < 2:
        raise ValueError(f"frames must be a whole number of at least 2, but is {frames!r}")
    if not seconds > 0:
        raise ValueError(f"seconds must be greater than 0, but is {seconds!r}")
    still = show(key_frames(scene, run, key, view, path), alt)
    records = np.linspace(0, len(run.time) - 1, frames).round().astype(int)
    figure, axes = plt.subplots(figsize=(3.6, 3.2), dpi=70)

    def frame(k):
        axes.clear()
        draw(scene, run, k, axes, view, path)

    film = FuncAnimation(figure, frame, frames=records, interval=1000 * seconds / frames)
    html = film.to_jshtml(default_mode="once")
    plt.close(figure)
    return Picture(still.png, alt, html)


def _positive(name, values):
    array = np.asarray(values, dtype=float)
    if array.ndim != 1 or len(array) == 0 or not np.all(array > 0):
        raise ValueError(f"{name} must be a list of numbers greater than 0, but is {values!r}")
    return array
