"""From a test to a design matrix to parameters, with a verdict. Stands on all rooms below; knows no file, no figure."""

from elastogeo.identify.fit import Harmonic, fitness, rmse, strongest_harmonic
from elastogeo.identify.identification import (
    Identification,
    Level,
    Local,
    Parameter,
    Pattern,
    Trace,
    adjacent,
    confounding_of,
    identify,
    local_estimates,
    systems_of,
    with_question,
)
from elastogeo.identify.preference import moving_axes, retaining_order
from elastogeo.identify.systems import RunSystem, Systems, merged, noise_of, run_systems
from elastogeo.identify.verdict import CONDITION_LIMIT, Check

__all__ = [
    "CONDITION_LIMIT",
    "Check",
    "Harmonic",
    "Identification",
    "Level",
    "Local",
    "Parameter",
    "Pattern",
    "RunSystem",
    "Systems",
    "Trace",
    "adjacent",
    "confounding_of",
    "fitness",
    "identify",
    "local_estimates",
    "merged",
    "moving_axes",
    "noise_of",
    "retaining_order",
    "rmse",
    "run_systems",
    "strongest_harmonic",
    "systems_of",
    "with_question",
]
