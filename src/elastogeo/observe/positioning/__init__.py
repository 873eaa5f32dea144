"""The positioning test of ISO 230-2: an axis goes to targets and stands; a laser, scale or sensor reads it."""

from elastogeo.observe.positioning.approaches import Approaches, approaches, distinct
from elastogeo.observe.positioning.targets import Positioning

__all__ = ["Approaches", "Positioning", "approaches", "distinct"]
