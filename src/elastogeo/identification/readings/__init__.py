"""What is looked at reading by reading: outliers, rounding, structure that is left, and what a result shows."""
