"""The checks of a prediction."""
