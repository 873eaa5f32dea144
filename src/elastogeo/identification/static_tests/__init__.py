"""What static tests show by themselves: hysteresis, straight line, Cartesian compliance, where in the drive an axis yields.

Stands on the files of `identification` and the rooms below it.
"""

from elastogeo.identification.static_tests.assessment import evaluate_static
from elastogeo.identification.static_tests.cartesian import CartesianCompliance, Principal, Symmetry
from elastogeo.identification.static_tests.collinear import (
    Collinear,
    CollinearStiffness,
    StiffnessScrew,
    collinear_stiffness,
    collinear_stiffness_of,
)
from elastogeo.identification.static_tests.drive_train import OnAxis, OnAxisPart, OnAxisRecord
from elastogeo.identification.static_tests.hysteresis import StaticHysteresis, hysteresis
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
    "Collinear",
    "CollinearStiffness",
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
    "collinear_stiffness_of",
    "evaluate_static",
    "hysteresis",
    "static_line",
]
