"""Languages of controls: each file writes and reads one, and registers itself with `program_files`."""
