"""The error sources: names, units, drivers, catalogue, presets; the readings they cause. Stands on `observe`, `machine`."""

from elastogeo.sources.catalogue import PRESETS, catalogue, select_sources
from elastogeo.sources.compliance import JointLoad
from elastogeo.sources.families import families, family
from elastogeo.sources.response import (
    column_ceilings,
    design_blocks,
    design_rows,
    exact_points,
    exact_response,
    linear_response,
    load_derivative,
    site_twists,
)
from elastogeo.sources.simulate import parameter_values, simulate
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Driver, Sign, Source, twist_unit
from elastogeo.sources.volumetric import NODES, direction_weights

__all__ = [
    "NODES",
    "PRESETS",
    "Driver",
    "JointLoad",
    "Sign",
    "Situation",
    "Source",
    "catalogue",
    "column_ceilings",
    "design_blocks",
    "design_rows",
    "direction_weights",
    "exact_points",
    "exact_response",
    "families",
    "family",
    "linear_response",
    "load_derivative",
    "parameter_values",
    "select_sources",
    "simulate",
    "site_twists",
    "twist_unit",
]
