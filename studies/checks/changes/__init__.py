"""The charts of a series of tests."""
