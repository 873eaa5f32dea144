"""Checks of an indicator test."""
