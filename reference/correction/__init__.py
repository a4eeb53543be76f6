"""Error correction: positions drift off their constraints, and five ways to bring them back (S13).

    projection      positions are moved back by the smallest move, all at once
    baumgarte       a share of the error each step is asked of the velocities, which keep it
    split_impulse   the same of velocities that are forgotten after the step
    nonlinear       a few Gauss–Seidel sweeps over the positions after the step
    soft            a spring and damper in place of the rigid constraint, stable at any stiffness

Each is a formula over arrays; ``simulators.fixed_step`` uses them, and ``projection`` serves joints under
"smooth" too. An error is φ of a joint, or a contact's gap where that is negative.

Slides S9, S13; lectures/09_error_correction.md.
"""

from .baumgarte import baumgarte_velocity
from .nonlinear import position_error, position_sweep
from .projection import (
    CLOSE,
    MOST_PROJECTIONS,
    displace,
    fill_momenta,
    fill_position_side,
    fill_velocity_side,
    project,
)
from .soft import soft_coefficients, soft_velocity
from .split_impulse import pseudo_velocities

# The parameters of each, and what engines set them to. fraction: of the error, a step; slop, m: what is left
# alone, so that contacts at rest stay in touch; most, m, in a sweep (Box2D 2.4: b2_baumgarte, b2_linearSlop,
# b2_maxLinearCorrection, 3 position iterations; Bullet 3: erp2, no slop). frequency, Hz, and damping ratio:
# Box2D 3.
CORRECTIONS = {
    "projection": {},
    "none": {},
    "baumgarte": {"fraction": 0.2, "slop": 0.005},
    "split_impulse": {"fraction": 0.2, "slop": 0.0},
    "nonlinear": {"fraction": 0.2, "slop": 0.005, "sweeps": 3, "most": 0.2},
    "soft": {"frequency": 30.0, "ratio": 10.0},
}

__all__ = [
    "CLOSE",
    "CORRECTIONS",
    "MOST_PROJECTIONS",
    "baumgarte_velocity",
    "displace",
    "fill_momenta",
    "fill_position_side",
    "fill_velocity_side",
    "position_error",
    "position_sweep",
    "project",
    "pseudo_velocities",
    "soft_coefficients",
    "soft_velocity",
]
