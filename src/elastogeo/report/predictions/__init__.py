"""What predictions look like: maps of the compliance at the tool."""
