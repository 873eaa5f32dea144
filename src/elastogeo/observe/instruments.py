"""The register of instruments. A new one is a file of this room that defines a set-up and registers it:

    @instrument("dial-gauge")
    @dataclass(frozen=True)
    class DialGauge:
        centre: Mapping[str, float] = ...
        quantities = ("deflection",)
        pose_quantity = "deflection"
        def observe(self, machine, run): ...
        def observe_all(self, machine, runs): ...
        def simulated(self, machine, run, respond, imperfection, random): ...

Nothing else changes: test files may name it, and the contract suite tests it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from elastogeo.discovery import import_all
from elastogeo.errors import InputError
from elastogeo.observe.setup import Setup

_REGISTER: dict[str, type[Setup]] = {}
S = TypeVar("S", bound=type)


def instrument(name: str) -> Callable[[S], S]:
    """Register a set-up class under the name that test files use."""

    def register(setup: S) -> S:
        _REGISTER[name] = setup
        return setup

    return register


def instruments() -> dict[str, type[Setup]]:
    """All instruments by name; every file of this room and its wings is looked at."""
    import_all(__name__.rpartition(".")[0])
    return dict(sorted(_REGISTER.items()))


def instrument_of(setup: Setup) -> str:
    """The name of a set-up's instrument; that of its class, if it is not registered."""
    return next((name for name, known in instruments().items() if known is type(setup)), type(setup).__name__)


def instrument_named(name: str) -> type[Setup]:
    """The set-up class of an instrument.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    known = instruments()
    if name not in known:
        raise InputError(f"there is no instrument {name!r}; there are: {', '.join(known)}")
    return known[name]
