"""The checks of a positioning test."""
