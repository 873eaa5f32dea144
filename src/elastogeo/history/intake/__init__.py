"""What comes into the history: tests and how they are told from each other, machines, instruments, events, baselines.

Stands on the room's own files, on `store`, and on `formats` for what a test is.
"""
