"""Which tests to run next on a machine that is watched. Stands on `changes`, and on the faults of `indicators`."""

from elastogeo.changes.next_tests.ways import Alternative, alternatives, planned_components

__all__ = ["Alternative", "alternatives", "planned_components"]
