"""The ball-roller test: the stiffness of a machine by direction (chapter 6).

Stands on the files of `identification` and the rooms below it.
"""

from elastogeo.identification.rollers.dynamometer import AgainstDynamometer, ComparedForce
from elastogeo.identification.rollers.laws import LawChoice, LawScore
from elastogeo.identification.rollers.result import StiffnessMap
from elastogeo.identification.rollers.rig_test import RigTest
from elastogeo.identification.rollers.stiffness import INCREMENT, MODELLED, SECANT, Stiffness
from elastogeo.identification.rollers.stiffness_map import map_stiffness
from elastogeo.identification.rollers.torque_parts import TorqueParts

__all__ = [
    "INCREMENT",
    "MODELLED",
    "SECANT",
    "AgainstDynamometer",
    "ComparedForce",
    "LawChoice",
    "LawScore",
    "RigTest",
    "Stiffness",
    "StiffnessMap",
    "TorqueParts",
    "map_stiffness",
]
