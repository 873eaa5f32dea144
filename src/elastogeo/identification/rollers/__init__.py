"""The ball-roller test: the stiffness of a machine by direction (chapter 6).

Stands on the files of `identification` and the rooms below it.
"""

from elastogeo.identification.rollers.laws import LawChoice, LawScore
from elastogeo.identification.rollers.result import INCREMENT, MODELLED, SECANT, Stiffness, StiffnessMap
from elastogeo.identification.rollers.stiffness_map import map_stiffness

__all__ = ["INCREMENT", "MODELLED", "SECANT", "LawChoice", "LawScore", "Stiffness", "StiffnessMap", "map_stiffness"]
