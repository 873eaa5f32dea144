"""What was copied, for a person or a program."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from elastogeo.cli import screen


def show_copied(done: str, copied: Any, as_json: bool) -> None:
    """Say what a copy holds."""
    if as_json:
        screen.show_json({"schema": "elastogeo.history-copied/1", **asdict(copied)})
        return
    screen.say(f"{done}: {copied.place}")
    screen.say(f"{sum(copied.rows.values())} rows, {copied.files} raw files ({copied.size} bytes); each was checked")
    if copied.wrong:
        screen.say(f"The history was not as it was written ({', '.join(copied.wrong)}); see: elastogeo history verify")
