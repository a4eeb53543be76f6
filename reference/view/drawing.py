"""Bodies drawn at an instant, at several side by side, and as an animation that needs no network.

In space a body is drawn as its faces, seen from far away; those that look away are left out. Bodies farther
off are drawn first.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import base64
import itertools

import numpy as np
from matplotlib.collections import PolyCollection

from ..rotation import over_arrays, rotate, rotate_in_plane
from ..shapes import Box, Capsule, Disc, Plane, Point, Polygon, Sphere
from .charts import BLACK, BLUE, GREEN, ORANGE, SKY, VERMILLION, YELLOW, Picture, plt, show

SIDES = (BLUE, SKY, VERMILLION, ORANGE, GREEN, YELLOW)  # of a box: −x, +x, −y, +y, −z, +z


def draw(scene, run, k=-1, axes=None, view=(20, 30), path=False):
    """Draw the bodies as they are at record k of the run. Returns the axes.

    view: elevation and azimuth, degrees, from which a scene in space is seen; the axes then show metres to
    the right and up, as seen. path: also the way of the centres so far.
    """
    if not -len(run.time) <= k < len(run.time):
        raise ValueError(f"k must be the number of a record, 0 … {len(run.time) - 1}, but is {k}")
    axes, k, planar = axes or plt.subplots(figsize=(4, 4))[1], k % len(run.time), scene.dimension == 2
    camera = np.eye(2) if planar else _camera(view)
    seen = run.position @ camera.T
    for i in range(len(scene.bodies)) if planar else np.argsort(seen[k, :, 2]):
        _draw_body(axes, scene.bodies[i], run.position[k, i], run.orientation[k, i], camera)
        if path:
            axes.plot(*seen[: k + 1, i, :2].T, color="grey", linewidth=0.8, linestyle="-", zorder=1)
    for ends in run.bodies.spring_ends:
        points = [p if i is None else run.position[k, i] + _turn(run.orientation[k, i], p) for i, p in ends]
        axes.plot(*(np.array(points) @ camera.T)[:, :2].T, color="grey", linestyle=":", zorder=4)
    (left, bottom), (right, top) = _limits(scene, seen)
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal", title=f"t = {run.time[k]:.4g} s")
    axes.set(xlabel="x (m)" if planar else "right (m)", ylabel="y (m)" if planar else "up (m)")
    return axes


def key_frames(scene, run, frames=5, view=(20, 30), path=False):
    """A figure with the bodies at ``frames`` instants, evenly spread over the run, side by side."""
    if not 1 <= frames <= 12:
        raise ValueError(f"frames must be a number from 1 to 12, but is {frames!r}")
    camera = np.eye(2) if scene.dimension == 2 else _camera(view)
    (left, bottom), (right, top) = _limits(scene, run.position @ camera.T)
    height = 0.8 + np.clip(1.6 * (top - bottom) / (right - left), 0.7, 4)
    figure, panels = plt.subplots(1, frames, figsize=(1.9 * frames, height), sharey=True, squeeze=False)
    for axes, k in zip(panels[0], _spread(run, frames), strict=True):
        draw(scene, run, k, axes, view, path)
        axes.label_outer()
    return figure


def animate(scene, run, alt, frames=30, seconds=4, key=5, view=(20, 30), path=False):
    """A Picture: key frames side by side with the description ``alt``, and under them a player.

    frames: pictures in the animation; seconds: how long it plays; key: how many key frames stand above it.
    """
    if not isinstance(frames, (int, np.integer)) or frames < 2:
        raise ValueError(f"frames must be a whole number of at least 2, but is {frames!r}")
    if not seconds > 0:
        raise ValueError(f"seconds must be greater than 0, but is {seconds!r}")
    still = show(key_frames(scene, run, key, view, path), alt)
    with plt.rc_context({"figure.constrained_layout.use": False}):  # finding a layout costs more than drawing
        figure, axes = plt.subplots(figsize=(3.2, 3.2), dpi=70)
    pictures = []
    for k in _spread(run, frames):
        axes.clear()
        draw(scene, run, k, axes, view, path).set_axis_off()  # the key frames have axes, and ticks cost time
        pictures.append(show(figure, alt).png)
    return Picture(still.png, alt, _player(pictures, 1000 * seconds / frames))


# What a click on the button and a move of the slider do. Without scripts the first picture stays.
PLAY = (
    "var b=this,s=b.nextElementSibling,on=b.timer;clearInterval(on);b.timer=0;if(on)return;"
    "if(s.value==s.max)s.value=0;b.timer=setInterval(function(){{s.value=+s.value+1;s.oninput();"
    "if(s.value==s.max){{clearInterval(b.timer);b.timer=0}}}},{pause:.0f})"
)
SLIDE = (
    "var f=this.parentElement.getElementsByTagName('img');"
    "for(var i=0;i<f.length;i++)f[i].style.display=i==this.value?'':'none'"
)


def _player(pictures, pause):
    """HTML with a button, a slider, and the pictures themselves, one shown at a time. Nothing is loaded."""
    images = [
        f'<img alt="" src="data:image/png;base64,{base64.b64encode(png).decode()}" '
        f'style="display:{"none" if k else ""}">'
        for k, png in enumerate(pictures)
    ]
    return (
        f'<div>{"".join(images)}<br><button onclick="{PLAY.format(pause=pause)}">play / stop</button>'
        f'<input type="range" aria-label="instant" min="0" max="{len(pictures) - 1}" value="0" '
        f'oninput="{SLIDE}"></div>'
    )


def faces(shape, dimension):
    """The polygons (k, d) that bound a shape, in its body's frame, and the colour of each.

    In space they go round anticlockwise as seen from outside. A Point and a Plane have none.
    """
    square = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    if dimension == 3:
        return _box_faces(shape, square) if isinstance(shape, Box) else _round_faces(shape)
    turns = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    circle = np.column_stack([np.cos(turns), np.sin(turns)])
    if isinstance(shape, Disc):  # half of it in another colour, so that one sees it turn
        return [shape.radius * circle, shape.radius * circle[:25]], (SKY, BLUE)
    if isinstance(shape, Capsule):
        ends = np.where(circle[:, 1:] > -1e-9, shape.half_length, -shape.half_length) * (0, 1)
        return [shape.radius * circle + ends], (SKY,)
    if isinstance(shape, Box):
        return [square * shape.half_extents], (SKY,)
    return ([np.array(shape.vertices)], (SKY,)) if isinstance(shape, Polygon) else ([], ())


def _box_faces(box, square):
    sides = itertools.product(range(3), (-1, 1))
    # Around the axis y, (x, z) is a left-handed pair: there the order is the other one.
    orders = [(axis, side, -side if axis == 1 else side) for axis, side in sides]
    polygons = [np.insert(square[::order], axis, side, axis=1) for axis, side, order in orders]
    return [polygon * box.half_extents for polygon in polygons], SIDES


def _round_faces(shape):
    """A ball as patches between circles of latitude, pulled apart at the equator; quarters in two colours."""
    if not isinstance(shape, (Sphere, Capsule)):
        return [], ()
    latitudes, turns = np.radians([-90, -60, -30, 0, 0, 30, 60, 90]), np.radians(np.arange(0, 361, 30))
    circle = np.column_stack([np.cos(turns), np.sin(turns), np.zeros(13)])
    ends = np.repeat((-1, 1), 4) * getattr(shape, "half_length", 0)
    up = np.column_stack([0 * ends, 0 * ends, shape.radius * np.sin(latitudes) + ends])
    rings = shape.radius * np.cos(latitudes)[:, None, None] * circle + up[:, None]
    patches = [(low, high, j) for low, high in itertools.pairwise(rings) for j in range(12)]
    polygons = [np.vstack([low[[j, j + 1]], high[[j + 1, j]]]) for low, high, j in patches]
    return polygons, [(BLUE, SKY)[j // 3 % 2] for _, _, j in patches]


def _draw_body(axes, body, position, orientation, camera):
    planar = len(position) == 2
    if isinstance(body.shape, Point):
        axes.plot(*(camera @ position)[:2], "o", color=BLACK, markersize=5, zorder=5)
    if isinstance(body.shape, Plane) and planar:
        x, y = body.shape.normal
        axes.axline(position, position + (-y, x), color="grey", linestyle="-")
    polygons, colours = faces(body.shape, len(position))
    seen = [(position + _turn(orientation, polygon)) @ camera.T for polygon in polygons]
    shown = [(p[:, :2], colour) for p, colour in zip(seen, colours, strict=True) if planar or _area(p) > 0]
    style = {"edgecolors": "0.25", "linewidths": 0.6, "zorder": 3}
    colours = [colour for _, colour in shown]
    axes.add_collection(PolyCollection([outline for outline, _ in shown], facecolors=colours, **style))


def _turn(orientation, r):
    return (rotate_in_plane if np.ndim(orientation) == 0 else over_arrays(rotate))(orientation, r)


def _camera(view):
    """The directions right, up and towards the viewer, as rows."""
    (se, sa), (ce, ca) = np.sin(np.radians(view)), np.cos(np.radians(view))
    return np.array([(-sa, ca, 0), (-se * ca, -se * sa, ce), (ce * ca, ce * sa, se)])


def _limits(scene, seen):
    """The lower left and the upper right corner of all that a run shows."""
    outlines = [p for body in scene.bodies for p in faces(body.shape, scene.dimension)[0]]
    sizes = [np.linalg.norm(polygon, axis=1).max() for polygon in outlines]
    reach = 1.1 * max(sizes, default=0) or 0.1 * np.ptp(seen[..., :2], axis=(0, 1)).max() or 1
    return np.min(seen[..., :2], axis=(0, 1)) - reach, np.max(seen[..., :2], axis=(0, 1)) + reach


def _area(polygon):
    x, y = polygon[:, 0], polygon[:, 1]
    return np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))


def _spread(run, frames):
    return np.linspace(0, len(run.time) - 1, frames).round().astype(int)
