"""The ball-roller test: the stiffness of a machine by direction (chapter 6).

Stands on the files of `identification` and the rooms below it.
"""

from elastogeo.identification.rollers.stiffness_map import Stiffness, StiffnessMap, map_stiffness

__all__ = ["Stiffness", "StiffnessMap", "map_stiffness"]
