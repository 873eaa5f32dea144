"""The ground of all figures: the house style, deviations around a circle, files."""
