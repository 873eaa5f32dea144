"""The checks of a compensation."""
