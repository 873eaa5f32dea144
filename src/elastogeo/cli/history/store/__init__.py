"""Commands that keep the store whole: make it, check it, copy it."""
