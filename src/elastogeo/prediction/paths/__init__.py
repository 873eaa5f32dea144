"""Deviation of the tool along a path: what a path asks of the parameters, and what the tests know of that.

Stands on the files of `prediction` and the rooms below it.
"""

from elastogeo.prediction.paths.ask import predict
from elastogeo.prediction.paths.deviation import DEVIATION_COMPONENTS, PARTS, Piece, PieceDeviation, deviations
from elastogeo.prediction.paths.predict import TOOL, known_deviation, path_deviation
from elastogeo.prediction.paths.result import PartOfDeviation, PathPrediction
from elastogeo.prediction.paths.simulation import simulated_points

__all__ = [
    "DEVIATION_COMPONENTS",
    "PARTS",
    "TOOL",
    "PartOfDeviation",
    "PathPrediction",
    "Piece",
    "PieceDeviation",
    "deviations",
    "known_deviation",
    "path_deviation",
    "predict",
    "simulated_points",
]
