"""The reference: a small physics engine to read, in the order of the lecture.

Start with ``Scene`` (what there is), ``simulate`` (run it) and ``model`` (what will be built). Data flows one
way: scene → bodies → forces → step → trajectory → measure → picture.

Slides S3–S18; lectures/index.md.
"""

from .joints import BallJoint, Distance, Fixed, Hinge, Slider, Universal
from .scene import Scene, Unsupported
from .shapes import Box, Capsule, Disc, Plane, Point, Polygon, Sphere
from .simulators import Simulation, model, simulate
from .trajectory import Trajectory

__all__ = [
    "BallJoint",
    "Box",
    "Capsule",
    "Disc",
    "Distance",
    "Fixed",
    "Hinge",
    "Plane",
    "Point",
    "Polygon",
    "Scene",
    "Simulation",
    "Slider",
    "Sphere",
    "Trajectory",
    "Universal",
    "Unsupported",
    "model",
    "simulate",
]
