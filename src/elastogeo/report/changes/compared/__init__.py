"""The parts of the view of two tests that are held against each other."""
