"""Views of long work: one job, and all that a history keeps."""
