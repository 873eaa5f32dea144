"""Figures and documents from frozen results: JSON, figures, one self-contained HTML page, a PDF. It computes nothing new.

Stands on `identify` and all rooms below. matplotlib, jinja2 and typst (the extra `elastogeo[report]`) are imported only when
something is drawn or a page is written: importing this room, JSON and the formatting of numbers need none of them.
"""

from elastogeo.report import showing as _showing  # noqa: F401  the renderer of every result registers itself
from elastogeo.report.as_json import (
    COMPARISON_SCHEMA,
    CONFOUNDING_SCHEMA,
    DIAGNOSIS_SCHEMA,
    IDENTIFICATION_SCHEMA,
    MACHINE_SCHEMA,
    STIFFNESS_SCHEMA,
    WHAT_IF_SCHEMA,
    comparison_json,
    confounding_json,
    diagnosis_json,
    identification_json,
    machine_json,
    stiffness_json,
    what_if_json,
)
from elastogeo.report.as_json.drive import DRIVE_SCHEMA, drive_json
from elastogeo.report.as_json.static import STATIC_SCHEMA, static_json
from elastogeo.report.drive_figures import drive_figures, save_drive_figures
from elastogeo.report.drive_text import (
    drive_rows,
    model_rows,
    note_sentences,
    samples_sentence,
    score_rows,
    searched_sentence,
)
from elastogeo.report.extra import MissingExtraError
from elastogeo.report.figures import FORMATS, figures, save_figures
from elastogeo.report.findings import (
    ComparisonRow,
    DiagnosisRow,
    WhatIfRow,
    comparison_rows,
    diagnosis_of,
    diagnosis_rows,
    what_if_rows,
)
from elastogeo.report.html import html_report, save_html
from elastogeo.report.numbers import DisplayUnit, display_unit, significant, value_with_uncertainty
from elastogeo.report.pdf import pdf_report, save_pdf
from elastogeo.report.sentences import says, sentence_of
from elastogeo.report.static import StaticTable, hysteresis_figure, save_static, static_tables
from elastogeo.report.stiffness import (
    BalanceRow,
    StiffnessRow,
    balance_rows,
    level_rows,
    overall_name,
    save_stiffness,
    stiffness_figure,
    stiffness_rows,
)
from elastogeo.report.text import ParameterRow, combination, display_units, in_micrometres, parameter_rows
from elastogeo.report.words import log_words

__all__ = [
    "COMPARISON_SCHEMA",
    "CONFOUNDING_SCHEMA",
    "DIAGNOSIS_SCHEMA",
    "DRIVE_SCHEMA",
    "FORMATS",
    "IDENTIFICATION_SCHEMA",
    "MACHINE_SCHEMA",
    "STATIC_SCHEMA",
    "STIFFNESS_SCHEMA",
    "WHAT_IF_SCHEMA",
    "BalanceRow",
    "ComparisonRow",
    "DiagnosisRow",
    "DisplayUnit",
    "MissingExtraError",
    "ParameterRow",
    "StaticTable",
    "StiffnessRow",
    "WhatIfRow",
    "balance_rows",
    "combination",
    "comparison_json",
    "comparison_rows",
    "confounding_json",
    "diagnosis_json",
    "diagnosis_of",
    "diagnosis_rows",
    "display_unit",
    "display_units",
    "drive_figures",
    "drive_json",
    "drive_rows",
    "figures",
    "html_report",
    "hysteresis_figure",
    "identification_json",
    "in_micrometres",
    "level_rows",
    "log_words",
    "machine_json",
    "model_rows",
    "note_sentences",
    "overall_name",
    "parameter_rows",
    "pdf_report",
    "samples_sentence",
    "save_drive_figures",
    "save_figures",
    "save_html",
    "save_pdf",
    "save_static",
    "save_stiffness",
    "says",
    "score_rows",
    "searched_sentence",
    "sentence_of",
    "significant",
    "static_json",
    "static_tables",
    "stiffness_figure",
    "stiffness_json",
    "stiffness_rows",
    "value_with_uncertainty",
    "what_if_json",
    "what_if_rows",
]
