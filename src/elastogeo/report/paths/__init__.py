"""Deviation along a tool path, shown: plan view, along the way, split into its parts."""
