"""The figures of an identification: one file for each kind of drawing."""
