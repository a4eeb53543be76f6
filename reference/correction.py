"""tmp"""
from .bodies import planar
from .compiled import compiled
from .rotation import exponential, multiply, quaternion, store_quaternion


@compiled
def displace(state, x, φ):
    """Move the bodies by x (M, d) m and turn them by the rotation vectors φ (r, 3), or the angles (r, 1)."""
    for i in range(len(x)):
        for k in range(x.shape[1]):
            state.x[i, k] += x[i, k]
    for i in range(len(φ)):
        if planar(state):
            state.q[i, 0] += φ[i, 0]
        else:
            turn = exponential((φ[i, 0], φ[i, 1], φ[i, 2]))
            store_quaternion(state.q, i, multiply(turn, quaternion(state.q, i)))
