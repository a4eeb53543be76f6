"""Inertia: the parallel-axis theorem, bodies made of parts, principal axes.

In space an inertia is a tensor (3, 3), in the plane a number; both in kg m², about the centre of mass unless
said.

Slide S4; lectures/02_equation_of_motion.md. Source: Goldstein, Classical Mechanics (1980), sections 5-3 and
5-4.
"""

import numpy as np

from . import inputs
from .rotation import quaternion_of_matrix, rotation_matrix


def parallel_axis(inertia, mass, offset):
    """The inertia about a point that lies ``offset`` from the centre of mass.

    ``I + m (r·r 1 − r rᵀ)`` in space: inertia (3, 3), offset (3,). ``I + m r·r`` in the plane: inertia a
    number, offset (2,).
    """
    r = np.asarray(offset, dtype=float)
    if len(r) == 2:
        return inertia + mass * r @ r
    return np.asarray(inertia, dtype=float) + mass * (r @ r * np.eye(3) - np.outer(r, r))


def composite_inertia(masses, centres, inertias, orientations=None):
    """Mass, centre of mass and inertia about that centre of a body made of k rigid parts.

    masses (k,); centres (k, 3) or (k, 2), in the body's frame; inertias (k, 3, 3) or (k,), each about its
    part's own centre, in the part's own frame; orientations (k, 4): quaternions part → body, None where the
    frames are parallel. A hole is a part of negative mass and inertia. Returns (mass, centre, inertia).
    Raises ValueError where the whole has no mass.
    """
    centres = np.asarray(centres, dtype=float)
    masses = inputs.array("masses", masses, (len(centres),))
    inertias = [np.asarray(inertia, dtype=float) for inertia in inertias]
    if len(inertias) != len(masses):
        raise ValueError(f"inertias must have one entry a part, {len(masses)}, but has {len(inertias)}")
    if orientations is not None:
        frames = [rotation_matrix(inputs.unit_quaternion("orientations", q)) for q in orientations]
        inertias = [R @ inertia @ R.T for R, inertia in zip(frames, inertias, strict=True)]
    mass = masses.sum()
    if not mass > 0:
        raise ValueError(f"masses must have a sum greater than 0, but {masses.tolist()} sum to {mass:g}")
    centre = masses @ centres / mass
    parts = zip(inertias, masses, centres, strict=True)
    return mass, centre, sum(parallel_axis(inertia, m, c - centre) for inertia, m, c in parts)


def principal_axes(inertia):
    """The principal moments (3,) and the quaternion (4,) principal frame → body frame of a tensor (3, 3).

    ``R diag(moments) Rᵀ`` is the tensor. A diagonal tensor keeps its axes and their order.
    """
    if np.count_nonzero(inertia - np.diag(np.diag(inertia))) == 0:
        return np.diag(inertia).copy(), np.array([1.0, 0, 0, 0])
    moments, R = np.linalg.eigh(inertia)
    R[:, 2] *= np.sign(np.linalg.det(R))  # a rotation, not a mirror
    return moments, quaternion_of_matrix(R)


def checked_inertia(name, value):
    """An inertia tensor (3, 3) from (3,) principal moments or a (3, 3) tensor that some rigid body could
    have.

    Raises ValueError: not symmetric, a moment that is not positive, or one larger than the other two
    together, which no distribution of mass has (triangle inequality).
    """
    shape = (3,) if np.ndim(value) == 1 else (3, 3)
    given = inputs.array(name, value, shape)
    tensor = np.diag(given) if given.ndim == 1 else given
    if np.abs(tensor - tensor.T).max() > 1e-9 * np.abs(tensor).max():
        raise ValueError(f"{name} must be symmetric, but is {value!r}")
    tensor = 0.5 * (tensor + tensor.T)
    moments = np.linalg.eigvalsh(tensor)
    shown = ", ".join(f"{moment:.6g}" for moment in moments)
    if moments[0] <= 0:
        raise ValueError(f"{name} must have positive principal moments, but they are {shown}")
    if moments[2] > (moments[0] + moments[1]) * (1 + 1e-9):
        raise ValueError(
            f"{name} must obey the triangle inequality, no principal moment larger than the other two "
            f"together, but its moments are {shown}"
        )
    return tensor
