"""How a planned test becomes a program: circles, and poses that are read at standstill.

The ground wing of the instruments: their own wings may import it.
"""

from elastogeo.observe.programs.circles import CircleTest, circle_blocks
from elastogeo.observe.programs.poses import approach, axis_words, pose_blocks, retreat

__all__ = [
    "CircleTest",
    "approach",
    "axis_words",
    "circle_blocks",
    "pose_blocks",
    "retreat",
]
