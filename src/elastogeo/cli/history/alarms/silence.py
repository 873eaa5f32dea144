"""`elastogeo history silence`: send nothing of a machine until a date."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, Store, Who


def silence(
    machine: Annotated[str, typer.Argument(metavar="MACHINE", help="By name.")],
    until: Annotated[str, typer.Option(help="The last day, 2026-12-24, or a time, 2026-12-24T12:00; or now, to end it.")],
    why: Annotated[str, typer.Option(help="It is kept with your name.")] = "",
    store: Store = STORE,
    who: Who = "",
) -> None:
    """Send nothing of a machine until a date. Alarms open all the same; what is held back is sent afterwards.

    \b
    Examples:
      elastogeo history silence "Mill 3" --until 2026-12-24 --why "taken apart"
      elastogeo history silence "Mill 3" --until now --why "runs again"
    """
    from elastogeo.cli import screen

    end = _end(until)
    with eg.History(store, who=who) as history:
        history.silence(machine, end, why)
    screen.say(
        f"{machine} is not silent any more." if end is None else f"{machine} is silent until {end:%Y-%m-%d %H:%M %Z}."
    )


def _end(until: str) -> datetime | None:
    """When a silence ends: a day ends at its midnight, where this computer is; None: now."""
    if until == "now":
        return None
    try:
        end = datetime.fromisoformat(until)
        if len(until) <= len("2026-12-24"):
            end += timedelta(days=1)
        end = end if end.tzinfo is not None else end.astimezone()
        end.astimezone(UTC)  # as it is kept: the last hours of the calendar are of no year there
    except (ValueError, OverflowError):
        raise eg.InputError(
            f"--until is {until!r}; give a day, as 2026-12-24, a time, as 2026-12-24T12:00, or now"
        ) from None
    return end
