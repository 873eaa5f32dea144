"""Where the commands are: the files of the wings, by the words that a person types.

A command is a function in a file of its name, in a wing of this room: `answers/identify.py` is `elastogeo identify`. Its
arguments and options are those of the function, the first line of its docstring is its line in the help. It reads, computes
and ends in `screen.show(result, report, as_json)`; what is heavy it imports inside. A name that Python keeps for itself has
an underscore behind it that nobody types: `import_.py` with its function `import_` is `import`.

A wing whose commands belong together is a group, `elastogeo NAME COMMAND`. It says so in its `__init__`::

    GROUP = "Keep the tests of machines, and say what has changed."
    ORDER = ("init", "import", "list")

`GROUP` is its line in the help, `ORDER` the order of its commands. The files of wings inside it are commands of the group
too. Nothing else changes: the help, the completion, the documentation and the tests find it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

ORDER = (
    "new", "simulate", "identify", "diagnose", "compare", "whatif", "stiffness", "static", "positioning", "drive",
    "record", "inspect", "calibrate", "explain", "plan", "nc", "map", "predict", "compensate", "history",
    "serve", "machines", "demo",
)  # fmt: skip
"""In which the help lists the commands; one that is not here comes last."""


@dataclass(frozen=True, slots=True)
class Command:
    """One command: the module it is in, which is imported when the function is asked for."""

    name: str
    module: str

    def function(self) -> Callable[..., Any]:
        """What the command does."""
        found: Callable[..., Any] = getattr(import_module(self.module), self.module.rpartition(".")[2])
        return found


@dataclass(frozen=True, slots=True)
class Group:
    """Commands behind one word, and what the help says of them."""

    name: str
    line: str
    commands: Mapping[str, Command] = field(default_factory=dict)


def doors() -> dict[str, Command | Group]:
    """The commands and groups, as the help lists them."""
    package = import_module(__name__.rpartition(".")[0])
    found: dict[str, Command | Group] = {}
    for name, wing in _wings(package):
        line = getattr(wing, "GROUP", None)
        commands = {one.name: one for one in _commands(wing)}
        found |= commands if line is None else {name: Group(name, line, _in_order(commands, wing.ORDER))}
    return _in_order(found, ORDER)


def every() -> tuple[str, ...]:
    """What is typed for every command, and for each group before its commands: `identify`, `history`, `history list`."""
    return tuple(
        typed
        for name, door in doors().items()
        for typed in (name, *(f"{name} {inner}" for inner in (door.commands if isinstance(door, Group) else ())))
    )


def _in_order(found: Mapping[str, Any], order: tuple[str, ...]) -> dict[str, Any]:
    known = {name: place for place, name in enumerate(order)}
    return {name: found[name] for name in sorted(found, key=lambda n: (known.get(n, len(known)), n))}


def _wings(package: Any) -> Iterator[tuple[str, Any]]:
    for file in iter_modules(package.__path__):
        if file.ispkg:
            yield file.name, import_module(f"{package.__name__}.{file.name}")


def _commands(wing: Any) -> Iterator[Command]:
    for file in iter_modules(wing.__path__):
        if not file.ispkg:
            yield Command(file.name.removesuffix("_"), f"{wing.__name__}.{file.name}")
    for _, inner in _wings(wing):
        yield from _commands(inner)
