"""Instruments that hold a ball while rotary axes turn about it: a nest of displacement sensors."""

from elastogeo.observe.nests.motion import BallMotion
from elastogeo.observe.nests.sphere_nest import SphereNest

__all__ = ["BallMotion", "SphereNest"]
