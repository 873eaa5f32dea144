"""The application: its commands, and what becomes of an error.

Exit codes: 0 done; 1 the data do not support what was asked (the message or the verdict says why); 2 wrong input or usage,
one clear error on standard error.
"""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from pkgutil import iter_modules, walk_packages
from typing import Annotated, Any

import typer

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

ORDER = (
    "new", "simulate", "identify", "diagnose", "compare", "whatif", "stiffness", "static", "positioning", "drive",
    "record", "inspect", "calibrate", "explain", "plan", "nc", "map", "predict", "compensate", "machines", "demo",
)  # fmt: skip
"""In which the help lists the commands; one that is not here comes last."""


def commands() -> list[Callable[..., Any]]:
    """The commands, as the help lists them: of every file in a wing of this room the function of its name."""
    found = _named()
    known = {name: place for place, name in enumerate(ORDER)}
    return [_command(found, name) for name in sorted(found, key=lambda n: (known.get(n, len(known)), n))]


def application(asked: str = "") -> typer.Typer:
    """The command line: with the one command that is asked, if there is one of that name, else with all."""
    found = _named()
    app = typer.Typer(rich_markup_mode=None, help=EXAMPLE, no_args_is_help=True, pretty_exceptions_enable=False)
    app.callback()(_options)
    for command in [_command(found, asked)] if asked in found else commands():
        app.command()(command)
    return app


def _named() -> dict[str, str]:
    """The module of each command."""
    return {module.rpartition(".")[2]: module for module in _files()}


def _command(found: dict[str, str], name: str) -> Callable[..., Any]:
    command: Callable[..., Any] = getattr(import_module(found[name]), name)
    return command


def _files() -> Iterator[str]:
    package = import_module(__name__.rpartition(".")[0])
    for wing in walk_packages(package.__path__, f"{package.__name__}."):
        if wing.ispkg:
            yield from (file.name for file in iter_modules(import_module(wing.name).__path__, f"{wing.name}."))


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
    gc.set_threshold(50_000)  # what a command makes lives to its end: looking for garbage takes a tenth of its time
    try:
        application(sys.argv[1] if len(sys.argv) > 1 else "")()
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
    print(f"elastogeo: {error}", file=sys.stderr)
    return code
