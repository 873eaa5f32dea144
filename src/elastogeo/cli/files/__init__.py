"""The commands that make, look at and record files: test folders, runs, calibrations, machines."""
