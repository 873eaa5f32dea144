"""A ball-roller test in words."""
