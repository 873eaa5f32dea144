"""The steps of an alarm, as the store names them."""

OPEN = "open"
WORSE = "worse"
HELD = "held"
RELEASED = "released"
ACKNOWLEDGED = "acknowledged"
REPAIRED = "closed as repaired"
FALSE = "closed as false"
CLOSED = (REPAIRED, FALSE)
"""Those that only a person takes, and that end it."""
