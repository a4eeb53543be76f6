"""Each body's frame as a matrix, made once for all the rows that it serves, and vectors turned by it.

Slides S5, S6; lectures/03_jacobian.md.
"""

import numpy as np

from ..bodies import planar
from ..compiled import lean, merged
from ..rotation import quaternion


@merged
def fill_frames(state, frame):
    """The rotation matrix of each body, row by row (r, 9); in the plane its cosine and sine (r, 2)."""
    for i in range(len(frame)):
        if planar(state):
            frame[i, 0], frame[i, 1] = np.cos(state.q[i, 0]), np.sin(state.q[i, 0])
            continue
        w, x, y, z = quaternion(state.q, i)
        frame[i, 0], frame[i, 1], frame[i, 2] = (
            1 - 2 * (y * y + z * z),
            2 * (x * y - w * z),
            2 * (x * z + w * y),
        )
        frame[i, 3], frame[i, 4], frame[i, 5] = (
            2 * (x * y + w * z),
            1 - 2 * (x * x + z * z),
            2 * (y * z - w * x),
        )
        frame[i, 6], frame[i, 7], frame[i, 8] = (
            2 * (x * z - w * y),
            2 * (y * z + w * x),
            1 - 2 * (x * x + y * y),
        )


@lean
def turned(frame, i, a):
    """The vector a, fixed to body i, in the world frame; a itself for the world and for points."""
    if i < 0 or i >= len(frame):
        return a
    return (
        frame[i, 0] * a[0] + frame[i, 1] * a[1] + frame[i, 2] * a[2],
        frame[i, 3] * a[0] + frame[i, 4] * a[1] + frame[i, 5] * a[2],
        frame[i, 6] * a[0] + frame[i, 7] * a[1] + frame[i, 8] * a[2],
    )


@lean
def turned_in_plane(frame, i, a):
    """The same in the plane."""
    if i < 0 or i >= len(frame):
        return a
    return frame[i, 0] * a[0] - frame[i, 1] * a[1], frame[i, 1] * a[0] + frame[i, 0] * a[1]
