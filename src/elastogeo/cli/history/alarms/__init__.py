"""Commands on alarms and their messages."""
