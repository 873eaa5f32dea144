"""Compliances that are not constant: what each joint gains with force, travel, feed or sign of its load."""
