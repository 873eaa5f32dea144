"""The report of a static test."""
