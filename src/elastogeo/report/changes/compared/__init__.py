"""Two tests of a history that are held against each other: the view and its parts."""
