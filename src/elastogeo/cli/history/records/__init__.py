"""Commands that write into the store: tests, machines, events, plans."""
