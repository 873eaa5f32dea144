"""The reports of a diagnosis, of a what-if, and of what changed between two tests."""
