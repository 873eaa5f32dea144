"""The application: its commands, and what becomes of an error.

Exit codes: 0 done; 1 the data do not support what was asked (the message or the verdict says why); 2 wrong input or usage,
one clear error on standard error.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Iterable
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from elastogeo.cli.doors import Command, doors
from elastogeo.cli.plain import plain
from elastogeo.errors import ElastogeoError, UnsupportedError
from elastogeo.version import VERSION

EXAMPLE = """\
Where is this machine soft, where is it crooked, how sure are we, and what could this test not tell?

\b
First steps:
  elastogeo demo                        identify the example test, write its report
  elastogeo new my-test                 make a folder for a test of your own
  elastogeo identify my-test            identify it
"""


def application(*asked: str) -> typer.Typer:
    """The command line: with the one command that is asked by its words, if there is one, else with all."""
    found = doors()
    first, second = (*asked, "", "")[:2]
    app = typer.Typer(
        cls=_InOrder, rich_markup_mode=None, help=EXAMPLE, no_args_is_help=True, pretty_exceptions_enable=False
    )
    app.callback()(_options)
    for name in _chosen(found, first):
        door = found[name]
        if isinstance(door, Command):
            app.command(door.name)(door.function())
            continue
        group = typer.Typer(rich_markup_mode=None, help=door.line, no_args_is_help=True)
        for inner in _chosen(door.commands, second if first == name else ""):
            group.command(inner)(door.commands[inner].function())
        app.add_typer(group, name=name)
    return app


class _InOrder(TyperGroup):
    """Lists groups where the order has them; typer would list them behind all commands."""

    def list_commands(self, _: Any) -> list[str]:
        """The names, as the help lists them."""
        return [name for name in doors() if name in self.commands]


def _chosen(found: Iterable[str], asked: str) -> list[str]:
    """The one that is asked for, else all."""
    found = list(found)
    return [asked] if asked in found else found


def _version(wanted: bool) -> None:
    if wanted:
        print(f"elastogeo {VERSION}")
        raise typer.Exit


def _options(
    _version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")] = False,
) -> None:
    """Options that every command shares: none but the version."""


def main() -> int:
    """Run the command line; return the exit code."""
    for library in ("OPENBLAS", "MKL", "OMP"):  # before numpy: on matrices of this size threads wait more than they work
        os.environ.setdefault(f"{library}_NUM_THREADS", "1")
    gc.set_threshold(50_000)  # what a command makes lives to its end: looking for garbage takes a tenth of its time
    try:
        application(*sys.argv[1:3])()
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else 0
    except UnsupportedError as error:
        return _refused(error, 1)
    except ElastogeoError as error:
        return _refused(error, 2)
    except BrokenPipeError:
        raise
    except OSError as error:
        return _refused(f"{error.filename or 'output'}: {error.strerror}; choose another place, or free some room", 2)
    except KeyboardInterrupt:
        return _refused("stopped by the user; nothing was left half written", 130)
    return 0


def _refused(error: object, code: int) -> int:
    print(plain(f"elastogeo: {error}"), file=sys.stderr)
    return code
