"""Figures and documents from frozen results: JSON, figures, one self-contained HTML page. It computes nothing new.

Stands on `identify` and all rooms below. matplotlib and jinja2 (the extra `elastogeo[report]`) are imported only when
something is drawn or a page is written: importing this room, JSON and the formatting of numbers need neither.
"""

from elastogeo.report.as_json import (
    CONFOUNDING_SCHEMA,
    IDENTIFICATION_SCHEMA,
    MACHINE_SCHEMA,
    confounding_json,
    identification_json,
    machine_json,
)
from elastogeo.report.extra import MissingExtraError
from elastogeo.report.figures import FORMATS, figures, save_figures
from elastogeo.report.html import html_report, save_html
from elastogeo.report.numbers import DisplayUnit, display_unit, significant, value_with_uncertainty
from elastogeo.report.text import ParameterRow, combination, display_units, in_micrometres, parameter_rows

__all__ = [
    "CONFOUNDING_SCHEMA",
    "FORMATS",
    "IDENTIFICATION_SCHEMA",
    "MACHINE_SCHEMA",
    "DisplayUnit",
    "MissingExtraError",
    "ParameterRow",
    "combination",
    "confounding_json",
    "display_unit",
    "display_units",
    "figures",
    "html_report",
    "identification_json",
    "in_micrometres",
    "machine_json",
    "parameter_rows",
    "save_figures",
    "save_html",
    "significant",
    "value_with_uncertainty",
]
