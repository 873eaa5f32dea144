"""From a test to a design matrix to parameters, with a verdict. Stands on all rooms below; knows no file, no figure."""

from typing import TYPE_CHECKING

from elastogeo.discovery import first_use

if TYPE_CHECKING:
    from elastogeo.identification.budget import SCATTER, Agreement, Budget, BudgetLine, agreement, uncertainty_budget
    from elastogeo.identification.calibrations import (
        BarCalibration,
        ForceCalibration,
        IndicatorTest,
        SetupDeflection,
        Spring,
        calibrate,
        calibrate_force,
        calibrate_setup,
    )
    from elastogeo.identification.campaigns.agreement import AgainstOthers, TestsAgreement
    from elastogeo.identification.campaigns.parts import Step, TestPart
    from elastogeo.identification.campaigns.scopes import plain
    from elastogeo.identification.change import SIGNIFICANT, Change, difference, local_change, run_dispersion
    from elastogeo.identification.check import Check
    from elastogeo.identification.explanation import Explanation, explain
    from elastogeo.identification.faults.cause_parts import CauseParts, RunParts, cause_parts, thinned_parts
    from elastogeo.identification.faults.circularity import Circularity, circularity
    from elastogeo.identification.faults.comparison import (
        BeforeAfter,
        Determined,
        Difference,
        compare,
        determined,
        differences_of,
        in_common,
        unchanged,
    )
    from elastogeo.identification.faults.diagnosis import Diagnosis, Fault, diagnose
    from elastogeo.identification.faults.what_if import WhatIf, what_if
    from elastogeo.identification.feed_drives.axis_drives import identify_drives
    from elastogeo.identification.feed_drives.result import AxisDrive, DriveIdentification
    from elastogeo.identification.fit import Fit, Harmonic, fitness, rmse, strongest_harmonic
    from elastogeo.identification.identification import consistency_of, identify
    from elastogeo.identification.influences import Effect, effect
    from elastogeo.identification.levels import ForceLevels, ForceSpread, force_levels
    from elastogeo.identification.local import adjacent, local_estimates
    from elastogeo.identification.model_choice.candidates import COMPLIANCE, FORCE, GEOMETRY, SET_UP
    from elastogeo.identification.model_choice.choice import compare_models
    from elastogeo.identification.model_choice.following import OffLevel
    from elastogeo.identification.model_choice.result import Candidate, ModelChoice
    from elastogeo.identification.model_choice.variable_compliance import VariableCompliance, gain_of
    from elastogeo.identification.moments import Moments, moments_of
    from elastogeo.identification.nests.deviations import BallDeviations, ball_deviations, shows_deviations
    from elastogeo.identification.physics import PHYSICALLY_CONSISTENT, Consistency, consistency
    from elastogeo.identification.positioning import (
        ByTarget,
        Contribution,
        PositioningResults,
        StandardValue,
        by_target,
        evaluate_positioning,
        standard_values,
    )
    from elastogeo.identification.preference import moving_axes, retaining_order
    from elastogeo.identification.question import (
        Asked,
        confounding_of,
        effects_of,
        sources_of,
        stated_shifts,
        systems_of,
        what_reciprocity_buys,
        with_question,
    )
    from elastogeo.identification.readings.shared_structure import shared_harmonic
    from elastogeo.identification.result import Identification, Level, Local, Parameter, Pattern, Response, Trace
    from elastogeo.identification.rollers.dynamometer import AgainstDynamometer, ComparedForce
    from elastogeo.identification.rollers.laws import LawChoice, LawScore
    from elastogeo.identification.rollers.result import StiffnessMap
    from elastogeo.identification.rollers.rig_test import RigTest
    from elastogeo.identification.rollers.stiffness import Stiffness
    from elastogeo.identification.rollers.stiffness_map import map_stiffness
    from elastogeo.identification.rollers.torque_parts import TorqueParts
    from elastogeo.identification.run_system import RunSystem
    from elastogeo.identification.static_tests.assessment import evaluate_static
    from elastogeo.identification.static_tests.cartesian import (
        CartesianCompliance,
        Symmetry,
        cartesian_compliance,
        cartesian_from_vectors,
        cartesian_of,
    )
    from elastogeo.identification.static_tests.collinear import (
        CollinearStiffness,
        Linear,
        StiffnessScrew,
        collinear_stiffness,
    )
    from elastogeo.identification.static_tests.drive_train import (
        OnAxis,
        OnAxisPart,
        OnAxisRecord,
        where_in_the_drive,
    )
    from elastogeo.identification.static_tests.hysteresis import StaticHysteresis, hysteresis
    from elastogeo.identification.static_tests.loading_branches import Branch, branches_of, turning_points
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
    from elastogeo.identification.symmetric_joints import Reciprocity, is_compliance, reciprocal_sources, reciprocity
    from elastogeo.identification.systems import Systems, merged, noise_of, run_systems
    from elastogeo.identification.verdict import CONDITION_LIMIT

__all__ = [
    "COMPLIANCE",
    "CONDITION_LIMIT",
    "FORCE",
    "GEOMETRY",
    "PHYSICALLY_CONSISTENT",
    "SCATTER",
    "SET_UP",
    "SIGNIFICANT",
    "AgainstDynamometer",
    "AgainstOthers",
    "Agreement",
    "Asked",
    "AxisDrive",
    "BallDeviations",
    "BarCalibration",
    "BeforeAfter",
    "Branch",
    "Budget",
    "BudgetLine",
    "ByTarget",
    "Candidate",
    "Cartesian",
    "CartesianCompliance",
    "CauseParts",
    "Change",
    "Check",
    "Circularity",
    "CollinearStiffness",
    "ComparedForce",
    "Consistency",
    "Contribution",
    "Determined",
    "Diagnosis",
    "Difference",
    "DriveIdentification",
    "Effect",
    "Explanation",
    "Fault",
    "Fit",
    "ForceCalibration",
    "ForceLevels",
    "ForceSpread",
    "Harmonic",
    "Identification",
    "IndicatorTest",
    "LawChoice",
    "LawScore",
    "Level",
    "Linear",
    "LoadStep",
    "LoadedPlace",
    "LoadedRun",
    "Local",
    "ModelChoice",
    "Moments",
    "OffLevel",
    "OnAxis",
    "OnAxisPart",
    "OnAxisRecord",
    "Parameter",
    "Pattern",
    "PositioningResults",
    "Principal",
    "Reciprocity",
    "Response",
    "RigTest",
    "RunParts",
    "RunSystem",
    "SetupDeflection",
    "Spring",
    "StandardValue",
    "StaticHysteresis",
    "StaticLine",
    "StaticResults",
    "Step",
    "Stiffness",
    "StiffnessMap",
    "StiffnessScrew",
    "Symmetry",
    "Systems",
    "TestPart",
    "TestsAgreement",
    "TorqueParts",
    "Trace",
    "TwistPlace",
    "TwistRun",
    "VariableCompliance",
    "WhatIf",
    "adjacent",
    "agreement",
    "ball_deviations",
    "branches_of",
    "by_target",
    "calibrate",
    "calibrate_force",
    "calibrate_setup",
    "cartesian_compliance",
    "cartesian_from_vectors",
    "cartesian_of",
    "cause_parts",
    "circularity",
    "collinear_stiffness",
    "compare",
    "compare_models",
    "confounding_of",
    "consistency",
    "consistency_of",
    "determined",
    "diagnose",
    "difference",
    "differences_of",
    "effect",
    "effects_of",
    "evaluate_positioning",
    "evaluate_static",
    "explain",
    "fitness",
    "force_levels",
    "gain_of",
    "hysteresis",
    "identify",
    "identify_drives",
    "in_common",
    "is_compliance",
    "local_change",
    "local_estimates",
    "map_stiffness",
    "merged",
    "moments_of",
    "moving_axes",
    "noise_of",
    "plain",
    "principal_directions",
    "reciprocal_sources",
    "reciprocity",
    "retaining_order",
    "rmse",
    "run_dispersion",
    "run_systems",
    "shared_harmonic",
    "shows_deviations",
    "sources_of",
    "standard_values",
    "stated_shifts",
    "static_line",
    "strongest_harmonic",
    "systems_of",
    "thinned_parts",
    "turning_points",
    "uncertainty_budget",
    "unchanged",
    "what_if",
    "what_reciprocity_buys",
    "where_in_the_drive",
    "with_question",
]

__getattr__ = first_use(
    __name__,
    {
        "budget": "Agreement Budget BudgetLine SCATTER agreement uncertainty_budget",
        "calibrations": "BarCalibration ForceCalibration IndicatorTest SetupDeflection "
        "Spring calibrate calibrate_force calibrate_setup",
        "campaigns.agreement": "AgainstOthers TestsAgreement",
        "campaigns.parts": "Step TestPart",
        "campaigns.scopes": "plain",
        "change": "Change SIGNIFICANT difference local_change run_dispersion",
        "check": "Check",
        "explanation": "Explanation explain",
        "faults.cause_parts": "CauseParts RunParts cause_parts thinned_parts",
        "faults.circularity": "Circularity circularity",
        "faults.comparison": "BeforeAfter Determined Difference compare determined differences_of in_common unchanged",
        "faults.diagnosis": "Diagnosis Fault diagnose",
        "faults.what_if": "WhatIf what_if",
        "feed_drives.axis_drives": "identify_drives",
        "feed_drives.result": "AxisDrive DriveIdentification",
        "fit": "Fit Harmonic fitness rmse strongest_harmonic",
        "identification": "consistency_of identify",
        "influences": "Effect effect",
        "levels": "ForceLevels ForceSpread force_levels",
        "local": "adjacent local_estimates",
        "model_choice.candidates": "COMPLIANCE FORCE GEOMETRY SET_UP",
        "model_choice.choice": "compare_models",
        "model_choice.following": "OffLevel",
        "model_choice.result": "Candidate ModelChoice",
        "model_choice.variable_compliance": "VariableCompliance gain_of",
        "moments": "Moments moments_of",
        "nests.deviations": "BallDeviations ball_deviations shows_deviations",
        "physics": "Consistency PHYSICALLY_CONSISTENT consistency",
        "positioning": "ByTarget Contribution PositioningResults "
        "StandardValue by_target evaluate_positioning standard_values",
        "preference": "moving_axes retaining_order",
        "question": "Asked confounding_of effects_of sources_of stated_shifts systems_of "
        "what_reciprocity_buys with_question",
        "readings.shared_structure": "shared_harmonic",
        "symmetric_joints": "Reciprocity is_compliance reciprocal_sources reciprocity",
        "result": "Identification Level Local Parameter Pattern Response Trace",
        "rollers.dynamometer": "AgainstDynamometer ComparedForce",
        "rollers.laws": "LawChoice LawScore",
        "rollers.result": "StiffnessMap",
        "rollers.rig_test": "RigTest",
        "rollers.stiffness": "Stiffness",
        "rollers.stiffness_map": "map_stiffness",
        "rollers.torque_parts": "TorqueParts",
        "run_system": "RunSystem",
        "static_tests.assessment": "evaluate_static",
        "static_tests.cartesian": "CartesianCompliance Symmetry cartesian_compliance cartesian_from_vectors cartesian_of",
        "static_tests.collinear": "CollinearStiffness Linear StiffnessScrew collinear_stiffness",
        "static_tests.drive_train": "OnAxis OnAxisPart OnAxisRecord where_in_the_drive",
        "static_tests.hysteresis": "StaticHysteresis hysteresis",
        "static_tests.loading_branches": "Branch branches_of turning_points",
        "static_tests.principal": "Principal principal_directions",
        "static_tests.result": "Cartesian LoadStep LoadedPlace LoadedRun StaticResults TwistPlace TwistRun",
        "static_tests.straight_line": "StaticLine static_line",
        "systems": "Systems merged noise_of run_systems",
        "verdict": "CONDITION_LIMIT",
    },
)
