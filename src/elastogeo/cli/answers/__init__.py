"""The commands that ask a test something: each reads, computes, and shows the view of its result."""
