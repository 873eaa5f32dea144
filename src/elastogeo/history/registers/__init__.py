"""What a history knows by heart: instruments and calibrations, what is wanted of each series, copies that were made."""
