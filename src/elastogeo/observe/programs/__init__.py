"""How a planned test becomes a program: circles, rotary axes that are followed, poses.

The ground wing of the instruments: their own wings may import it.
"""

from elastogeo.observe.programs.circles import CircleTest, circle_blocks
from elastogeo.observe.programs.following import Followed, FollowedRun, following_blocks
from elastogeo.observe.programs.poses import Pose, approach, axis_words, movable, pose_blocks, retreat

__all__ = [
    "CircleTest",
    "Followed",
    "FollowedRun",
    "Pose",
    "approach",
    "axis_words",
    "circle_blocks",
    "following_blocks",
    "movable",
    "pose_blocks",
    "retreat",
]
