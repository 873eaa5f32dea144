"""The report of a ball-roller test."""
