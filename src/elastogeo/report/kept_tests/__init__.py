"""One test of a history: what is known of it and where it comes from, beside what it says."""
