"""`elastogeo history instrument`: add an instrument, or a calibration of one; or list all."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store, Who


def instrument(
    serial: Annotated[
        str,
        typer.Argument(
            metavar="[SERIAL]", help="Its serial number, as tests say it under [about]; without it, all are listed."
        ),
    ] = "",
    kind: Annotated[str, typer.Option(help="loaded-ball-bar, ...; by default that of its first test.")] = "",
    calibrated: Annotated[str, typer.Option(help="Day of a calibration: 2026-03-01.")] = "",
    due: Annotated[str, typer.Option(help="Day until which it holds.")] = "",
    certificate: Annotated[str, typer.Option(help="Its number.")] = "",
    store: Store = STORE,
    who: Who = "",
    as_json: AsJson = False,
) -> None:
    """Add an instrument, or a calibration of it; or list all.

    \b
    Examples:
      elastogeo history instrument B7 --calibrated 2026-03-01 --due 2027-03-01
      elastogeo history instrument
    """
    from elastogeo.cli import screen

    said = any((kind, calibrated, due, certificate))
    with eg.History(store, who=who) as history:
        if not serial and not said:
            screen.show(history.instruments(), None, as_json)
            return
        known = history.add_instrument(serial, kind=kind, calibrated=calibrated, due=due, certificate=certificate)
    holds = f", calibrated {calibrated}{f', due {due}' if due else ''}" if calibrated else ""
    screen.say(f"Instrument {known.serial}{f', {known.kind}' if known.kind else ''}{holds}")
