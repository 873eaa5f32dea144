"""Many tests of one machine as one system: what belongs to which test, what each counts, and what each adds."""
