"""Commands that say what the machine will do."""
