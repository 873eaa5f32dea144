"""Commands that look ahead: which tests to run, and the programs for them."""
