"""The report of a bar's calibration: its force against pressure, and how far its set-up gives way."""
