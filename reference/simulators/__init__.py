"""Simulators, one file a family (S3); ``simulate`` chooses what the scene needs.

Slides S3, S9; lectures/02_equation_of_motion.md.
"""

from .model import Model, model
from .settings import FAMILIES, SIMULATORS, Settings
from .simulate import Simulation, simulate

__all__ = ["FAMILIES", "SIMULATORS", "Model", "Settings", "Simulation", "model", "simulate"]
