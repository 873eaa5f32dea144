"""The command line: doors only, no algorithm. One command is one file; nobody imports this room.

`main` is the entry point. Nothing heavy is imported before a command needs it.
"""

from elastogeo.cli.app import main

__all__ = ["main"]
