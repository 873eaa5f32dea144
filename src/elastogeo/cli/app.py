"""The application: its commands, and what becomes of an error.

Exit codes: 0 done; 1 the data do not support what was asked (the message or the verdict says why); 2 wrong input or usage,
one clear error on standard error.
"""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from elastogeo import __version__
from elastogeo.cli import (
    brbd,
    compare,
    confounding,
    demo,
    diagnose,
    drive,
    identify,
    machines,
    new,
    record,
    simulate,
    static,
    whatif,
)
from elastogeo.errors import ElastogeoError, UnsupportedError

EXAMPLE = """\
Where is this machine soft, where is it crooked, how sure are we, and what could this test not tell?

\b
First steps:
  elastogeo demo                        identify the example test, write its report
  elastogeo new my-test                 make a folder for a test of your own
  elastogeo identify my-test            identify it
"""

app = typer.Typer(rich_markup_mode=None, help=EXAMPLE, no_args_is_help=True, pretty_exceptions_enable=False)
for module in (demo, new, simulate, identify, diagnose, whatif, compare, brbd, static, drive, record, confounding, machines):
    app.command()(getattr(module, module.__name__.rpartition(".")[2]))


def _version(wanted: bool) -> None:
    if wanted:
        print(f"elastogeo {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    _version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")] = False,
) -> None:
    """Options that every command shares: none but the version."""


def main() -> int:
    """Run the command line; return the exit code."""
    try:
        app(standalone_mode=True)
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
