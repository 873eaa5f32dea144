"""Views of change detection: one series, a machine with all its series, a fleet."""

from elastogeo.report.changes.words import shown_unit, taken

__all__ = ["shown_unit", "taken"]
