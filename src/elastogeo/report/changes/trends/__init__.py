"""The trend of an indicator: as a figure for reports, as plain shapes for pages."""
