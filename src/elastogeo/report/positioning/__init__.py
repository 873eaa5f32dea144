"""The report of a positioning test."""
