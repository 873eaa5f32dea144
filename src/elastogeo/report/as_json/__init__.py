"""Results as JSON: what `--json` prints and a page's `.json` twin holds. Plain types, nothing rounded, null for no number.

One file per document; each says at its top what every key means. A number without a value (a fitness of readings that do not
vary, infinite degrees of freedom or travel) is null. Within one schema number, keys are added but never changed or removed.
"""

from elastogeo.report.as_json.comparison import COMPARISON_SCHEMA, comparison_json
from elastogeo.report.as_json.confounding import CONFOUNDING_SCHEMA, confounding_json
from elastogeo.report.as_json.diagnosis import DIAGNOSIS_SCHEMA, diagnosis_json
from elastogeo.report.as_json.drive import DRIVE_SCHEMA, drive_json
from elastogeo.report.as_json.identification import IDENTIFICATION_SCHEMA, identification_json
from elastogeo.report.as_json.machine import MACHINE_SCHEMA, machine_json
from elastogeo.report.as_json.static import STATIC_SCHEMA, static_json
from elastogeo.report.as_json.stiffness import STIFFNESS_SCHEMA, stiffness_json
from elastogeo.report.as_json.what_if import WHAT_IF_SCHEMA, what_if_json

__all__ = [
    "COMPARISON_SCHEMA",
    "CONFOUNDING_SCHEMA",
    "DIAGNOSIS_SCHEMA",
    "DRIVE_SCHEMA",
    "IDENTIFICATION_SCHEMA",
    "MACHINE_SCHEMA",
    "STATIC_SCHEMA",
    "STIFFNESS_SCHEMA",
    "WHAT_IF_SCHEMA",
    "comparison_json",
    "confounding_json",
    "diagnosis_json",
    "drive_json",
    "identification_json",
    "machine_json",
    "static_json",
    "stiffness_json",
    "what_if_json",
]
