"""What static tests show by themselves: hysteresis, straight line, Cartesian compliance, where in the drive an axis yields.

Stands on the files of `identification` and the rooms below it.
"""

from elastogeo.identification.static_tests.assessment import evaluate_static
from elastogeo.identification.static_tests.cartesian import CartesianCompliance, Symmetry
from elastogeo.identification.static_tests.collinear import CollinearStiffness, Linear, StiffnessScrew, collinear_stiffness
from elastogeo.identification.static_tests.drive_train import OnAxis, OnAxisPart, OnAxisRecord
from elastogeo.identification.static_tests.hysteresis import StaticHysteresis, hysteresis
from elastogeo.identification.static_tests.principal import Principal, principal_directions
from elastogeo.identification.static_tests.result import (
    Cartesian,
    LoadedPlace,
    LoadedRun,
    LoadStep,
    StaticResults,
    TwistPlace,
    TwistRun,
)
from elastogeo.identification.static_tests.straight_line import StaticLine, static_line

__all__ = [
    "Cartesian",
    "CartesianCompliance",
    "CollinearStiffness",
    "Linear",
    "LoadStep",
    "LoadedPlace",
    "LoadedRun",
    "OnAxis",
    "OnAxisPart",
    "OnAxisRecord",
    "Principal",
    "StaticHysteresis",
    "StaticLine",
    "StaticResults",
    "StiffnessScrew",
    "Symmetry",
    "TwistPlace",
    "TwistRun",
    "collinear_stiffness",
    "evaluate_static",
    "hysteresis",
    "principal_directions",
    "static_line",
]
