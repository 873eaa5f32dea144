"""Labelled linear least squares, knowing nothing of machines: factor, confounding, solutions. Stands on `errors`."""

from elastogeo.estimate.chi_bar_square import p_value_bound
from elastogeo.estimate.clusters import runs_needed, solve_as_runs_show, solve_by_run
from elastogeo.estimate.cone import Block, Projection, PsdCone, is_never_negative, project, psd_cone
from elastogeo.estimate.confounding import NULL_TOLERANCE, RANK_TOLERANCE, Confounding, confounding
from elastogeo.estimate.distributions import DISTRIBUTIONS, Influence, coverage_factor
from elastogeo.estimate.estimate import Estimate
from elastogeo.estimate.factor import BLOCK_ROWS, Array, Factor, empty_factor, factor_blocks, merge, select
from elastogeo.estimate.propagation import (
    MonteCarlo,
    draw_estimates,
    effective_degrees_of_freedom,
    first_order,
    monte_carlo,
    numerical_tolerance,
)
from elastogeo.estimate.refinement import refine
from elastogeo.estimate.repeats import Common, Repeatability, repeatability
from elastogeo.estimate.robust import HUBER, huber_weights
from elastogeo.estimate.run_scatter import RunScatter, ScatterAlong
from elastogeo.estimate.solution import SOLVABLE, Noise, Solution, minimum_norm, solve, white_noise

__all__ = [
    "BLOCK_ROWS",
    "DISTRIBUTIONS",
    "HUBER",
    "NULL_TOLERANCE",
    "RANK_TOLERANCE",
    "SOLVABLE",
    "Array",
    "Block",
    "Common",
    "Confounding",
    "Estimate",
    "Factor",
    "Influence",
    "MonteCarlo",
    "Noise",
    "Projection",
    "PsdCone",
    "Repeatability",
    "RunScatter",
    "ScatterAlong",
    "Solution",
    "confounding",
    "coverage_factor",
    "draw_estimates",
    "effective_degrees_of_freedom",
    "empty_factor",
    "factor_blocks",
    "first_order",
    "huber_weights",
    "is_never_negative",
    "merge",
    "minimum_norm",
    "monte_carlo",
    "numerical_tolerance",
    "p_value_bound",
    "project",
    "psd_cone",
    "refine",
    "repeatability",
    "runs_needed",
    "select",
    "solve",
    "solve_as_runs_show",
    "solve_by_run",
    "white_noise",
]
