"""The report of identified feed drives."""
