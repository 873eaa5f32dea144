"""The pages: placeholder."""
