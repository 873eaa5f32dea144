"""The report of a machine: its axes, and what is assumed of it."""
