"""The checks of a series of tests, and what is said of a change."""
