"""Commands that say how machines are."""
