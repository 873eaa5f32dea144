"""Instruments with a roller that presses on a ball; the force comes from motor currents."""

from elastogeo.observe.rollers.ball_roller import BallRoller, Pressed
from elastogeo.observe.rollers.rig import Rig

__all__ = ["BallRoller", "Pressed", "Rig"]
