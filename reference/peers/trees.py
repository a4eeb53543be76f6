"""The trees that the joints of a scene make: who hangs on whom, and which joints close a loop.

Slides S3, S5, S9; lectures/04_embedding.md.
"""

from typing import NamedTuple


class Branch(NamedTuple):
    """A body and the joint by which it hangs on its parent (None: on the base that stands in the world)."""

    body: int
    joint: object
    parent: int | None


def trees(scene):
    """The scene's trees as (base's number or None, list of Branch, parents first), and the joints left over.

    A joint is left over where it closes a loop.
    """
    joints_of = {i: [] for i, body in enumerate(scene.bodies) if not body.static}
    held = []  # branches on the world, or on what is static
    for joint in scene.joints:
        for i, other in (joint.ends, joint.ends[::-1]):
            if i in joints_of:
                joints_of[i].append(joint)
                if other not in joints_of:
                    held.append(Branch(i, joint, None))
    found, reached = [], set()
    for first in joints_of:
        if first not in reached:
            members = _members(first, joints_of)
            roots = [branch for branch in held if branch.body in members]
            base = None if roots else first
            reached.add(base)
            found.append((base, _grown(roots or _branches_from(first, joints_of), joints_of, reached)))
    used = {id(branch.joint) for _, branches in found for branch in branches}
    return found, [joint for joint in scene.joints if id(joint) not in used]


def _members(first, joints_of):
    """The moving bodies that are joined to ``first``, directly or not."""
    members, queue = {first}, [first]
    for i in queue:
        new = [b.body for b in _branches_from(i, joints_of) if b.body not in members]
        members.update(new)
        queue += new
    return members


def _branches_from(i, joints_of):
    return [
        Branch(other, joint, i)
        for joint in joints_of[i]
        for other in joint.ends
        if other in joints_of and other != i
    ]


def _grown(branches, joints_of, reached):
    """A tree's branches, from those at its base; ``reached`` gets the bodies.

    Each body hangs on the nearest to the base; the order is the engine's: a body, then all that hangs on it.
    """
    queue, hanging = list(branches), {}
    for branch in queue:
        if branch.body not in reached:
            reached.add(branch.body)
            hanging.setdefault(branch.parent, []).append(branch)
            queue += _branches_from(branch.body, joints_of)
    ordered, stack = [], hanging[branches[0].parent][::-1] if branches else []
    while stack:
        ordered.append(stack.pop())
        stack += hanging.get(ordered[-1].body, [])[::-1]
    return ordered
