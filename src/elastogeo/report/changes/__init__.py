"""Views of change detection: one series, a machine with all its series, a fleet."""

from elastogeo.report.changes.fleets.rows import MOST_ROWS
from elastogeo.report.changes.rows import MOST_TESTS
from elastogeo.report.changes.words import shown_unit, taken

__all__ = ["MOST_ROWS", "MOST_TESTS", "shown_unit", "taken"]
