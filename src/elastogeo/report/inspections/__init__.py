"""The view of a file that was looked at: its columns or channels, and how a test file maps them."""
