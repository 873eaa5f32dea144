"""The audit trail of a history as a view."""
