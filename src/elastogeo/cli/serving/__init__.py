"""Commands that run until they are stopped and answer others: the pages."""
