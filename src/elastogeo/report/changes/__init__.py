"""Views of change detection: one series, a machine with all its series, a fleet."""
