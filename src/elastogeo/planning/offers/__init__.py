"""Tests that could be made: one file for a kind of instrument, which registers itself with `proposes`.

A proposal is an endless stream of drafts, made of `Means` and a random generator: a `Candidate` whose test stands within the
travel and keeps clear, or None for a draw that does not. `candidates` takes as many as are wanted.
"""
