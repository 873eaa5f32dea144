"""The clock: what the history takes as now. Tests set it."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime


def _system() -> datetime:
    return datetime.now(UTC)


source: Callable[[], datetime] = _system
"""Where the time comes from."""


def now() -> datetime:
    """The time, with its zone (UTC), in whole microseconds."""
    return source()
