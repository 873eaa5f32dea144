"""A fleet: its machines in one line each, the worst first, and those that fit what is asked for."""
