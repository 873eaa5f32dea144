"""Labelled linear least squares, knowing nothing of machines: factor, confounding, solutions. Stands on `errors`."""

from elastogeo.estimate.confounding import NULL_TOLERANCE, RANK_TOLERANCE, Confounding, confounding
from elastogeo.estimate.factor import BLOCK_ROWS, Factor, empty_factor, factor_blocks, merge, select
from elastogeo.estimate.repeats import Repeatability, repeatability
from elastogeo.estimate.solution import Noise, Solution, minimum_norm, solve, white_noise

__all__ = [
    "BLOCK_ROWS",
    "NULL_TOLERANCE",
    "RANK_TOLERANCE",
    "Confounding",
    "Factor",
    "Noise",
    "Repeatability",
    "Solution",
    "confounding",
    "empty_factor",
    "factor_blocks",
    "merge",
    "minimum_norm",
    "repeatability",
    "select",
    "solve",
    "white_noise",
]
