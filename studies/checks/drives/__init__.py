"""Checks of a feed drive."""
