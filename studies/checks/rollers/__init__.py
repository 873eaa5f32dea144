"""Checks of a ball-roller test."""
