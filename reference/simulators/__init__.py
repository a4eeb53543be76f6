"""Simulators, one file a family (S3); ``simulate`` chooses what the scene needs.
lectures/02_equation_of_motion.md.
"""

from .model import Model, model
from .simulate import FAMILIES, SIMULATORS, Simulation, simulate

__all__ = ["FAMILIES", "SIMULATORS", "Model", "Simulation", "model", "simulate"]
