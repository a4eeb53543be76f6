"""Helpers of a made-up exercise, which has nothing in common with any of the course's."""


def spring(stiffness):
    """A force that grows with the stretch."""
    return lambda stretch: -stiffness * stretch
