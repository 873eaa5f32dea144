"""Views of what a history knows by heart: instruments, what is wanted of each series, copies that were made."""
