"""`elastogeo history instrument`: add an instrument, or a calibration of one."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, Store, Who


def instrument(
    serial: Annotated[str, typer.Argument(help="Its serial number, as tests say it under [about].")],
    kind: Annotated[str, typer.Option(help="loaded-ball-bar, ...; by default that of its first test.")] = "",
    calibrated: Annotated[str, typer.Option(help="Day of a calibration: 2026-03-01.")] = "",
    due: Annotated[str, typer.Option(help="Day until which it holds.")] = "",
    certificate: Annotated[str, typer.Option(help="Its number.")] = "",
    store: Store = STORE,
    who: Who = "",
) -> None:
    """Add an instrument, or a calibration of it.

    \b
    Example:
      elastogeo history instrument B7 --calibrated 2026-03-01 --due 2027-03-01
    """
    from elastogeo.cli import screen

    with eg.History(store, who=who) as history:
        known = history.add_instrument(serial, kind=kind, calibrated=calibrated, due=due, certificate=certificate)
    holds = f", calibrated {calibrated}{f', due {due}' if due else ''}" if calibrated else ""
    screen.say(f"Instrument {known.serial}{f', {known.kind}' if known.kind else ''}{holds}")
