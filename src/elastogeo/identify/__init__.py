"""From a test to a design matrix to parameters, with a verdict. Stands on all rooms below; knows no file, no figure."""

from elastogeo.identify.budget import Agreement, Budget, BudgetLine, agreement, uncertainty_budget
from elastogeo.identify.cartesian_stiffness import (
    CartesianCompliance,
    Principal,
    Symmetry,
    cartesian_compliance,
    cartesian_from_vectors,
    cartesian_of,
)
from elastogeo.identify.change import SIGNIFICANT, Change, difference, local_change, run_dispersion
from elastogeo.identify.check import Check
from elastogeo.identify.circularity import Circularity, circularity
from elastogeo.identify.comparison import BeforeAfter, Difference, compare_tests
from elastogeo.identify.diagnosis import Diagnosis, Fault, diagnose
from elastogeo.identify.drives import AxisDrive, DriveIdentification, identify_drives
from elastogeo.identify.fit import Harmonic, fitness, rmse, strongest_harmonic
from elastogeo.identify.hysteresis import StaticHysteresis, hysteresis
from elastogeo.identify.identification import (
    adjacent,
    confounding_of,
    consistency_of,
    effects_of,
    identify,
    local_estimates,
    systems_of,
    what_reciprocity_buys,
    with_question,
)
from elastogeo.identify.influences import Effect, effect, effects
from elastogeo.identify.loading_branches import Branch, branches_of, turning_points
from elastogeo.identify.models import Comparison, ModelFit, compare_models
from elastogeo.identify.on_axis import OnAxis, OnAxisCompliance, OnAxisPart, OnAxisRecord, where_in_the_drive
from elastogeo.identify.physics import Consistency, Reciprocity, consistency, reciprocal_sources, reciprocity
from elastogeo.identify.preference import moving_axes, retaining_order
from elastogeo.identify.result import Identification, Level, Local, Parameter, Pattern, Trace
from elastogeo.identify.static_line import Estimate, StaticLine, static_line
from elastogeo.identify.static_test import static_results
from elastogeo.identify.static_test_result import Cartesian, LoadedPlace, LoadedRun, LoadStep, StaticResults, TwistRun
from elastogeo.identify.stiffness import Stiffness, StiffnessMap, stiffness_map
from elastogeo.identify.systems import RunSystem, Systems, merged, noise_of, run_systems
from elastogeo.identify.verdict import CONDITION_LIMIT
from elastogeo.identify.what_if import WhatIf, what_if

__all__ = [
    "CONDITION_LIMIT",
    "SIGNIFICANT",
    "Agreement",
    "AxisDrive",
    "BeforeAfter",
    "Branch",
    "Budget",
    "BudgetLine",
    "Cartesian",
    "CartesianCompliance",
    "Change",
    "Check",
    "Circularity",
    "Comparison",
    "Consistency",
    "Diagnosis",
    "Difference",
    "DriveIdentification",
    "Effect",
    "Estimate",
    "Fault",
    "Harmonic",
    "Identification",
    "Level",
    "LoadStep",
    "LoadedPlace",
    "LoadedRun",
    "Local",
    "ModelFit",
    "OnAxis",
    "OnAxisCompliance",
    "OnAxisPart",
    "OnAxisRecord",
    "Parameter",
    "Pattern",
    "Principal",
    "Reciprocity",
    "RunSystem",
    "StaticHysteresis",
    "StaticLine",
    "StaticResults",
    "Stiffness",
    "StiffnessMap",
    "Symmetry",
    "Systems",
    "Trace",
    "TwistRun",
    "WhatIf",
    "adjacent",
    "agreement",
    "branches_of",
    "cartesian_compliance",
    "cartesian_from_vectors",
    "cartesian_of",
    "circularity",
    "compare_models",
    "compare_tests",
    "confounding_of",
    "consistency",
    "consistency_of",
    "diagnose",
    "difference",
    "effect",
    "effects",
    "effects_of",
    "fitness",
    "hysteresis",
    "identify",
    "identify_drives",
    "local_change",
    "local_estimates",
    "merged",
    "moving_axes",
    "noise_of",
    "reciprocal_sources",
    "reciprocity",
    "retaining_order",
    "rmse",
    "run_dispersion",
    "run_systems",
    "static_line",
    "static_results",
    "stiffness_map",
    "strongest_harmonic",
    "systems_of",
    "turning_points",
    "uncertainty_budget",
    "what_if",
    "what_reciprocity_buys",
    "where_in_the_drive",
    "with_question",
]
