"""Joints as a user declares them, and what each is made of: rows, one for each thing that must not change.

A joint joins body i to body j: i → j is a → b, or the world → a where b is None. What it leaves free has no
row, and no force: λ = 0 there (S6). Where the user asks for a spring, a motor or a limit, the joint's own
*coordinate* gets a row as well: a Hinge's angle, a Slider's displacement, a Distance's length.

Slides S5, S6; lectures/03_jacobian.md.
"""

from .joint import Joint
from .kinds import BallJoint, Distance, Fixed, Hinge, Slider, Universal
from .row import ANGULAR, DISTANCE, LINEAR, TURN, Row

JOINTS = (BallJoint, Hinge, Slider, Fixed, Universal, Distance)

__all__ = ["ANGULAR", "DISTANCE", "JOINTS", "LINEAR", "TURN", "Joint", "Row"]
__all__ += [kind.__name__ for kind in JOINTS]
