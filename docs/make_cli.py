"""Write the reference of the command line, docs/cli.md, from the help texts of the commands: `python docs/make_cli.py`."""

from pathlib import Path

from typer.testing import CliRunner

from elastogeo.cli.app import application
from elastogeo.cli.doors import every

PAGE = Path(__file__).with_name("cli.md")
INTRODUCTION = """\
# Command line

Exit codes: 0 done; 1 the data do not support what was asked, the message says why; 2 wrong input or usage, one error on
standard error. `--json` prints one object on standard output and nothing else (see [Files](formats.md)). Colours follow
`NO_COLOR`. `elastogeo --install-completion` sets up completion for your shell.

This page is written from the help texts by `docs/make_cli.py`.
"""


def reference() -> str:
    """The page as it should be."""
    sections = [INTRODUCTION, section()]
    return "\n".join([*sections, *(section(*typed.split()) for typed in every())])


def section(*command: str) -> str:
    """The help text of one command or group, by its words."""
    as_shown = {"prog_name": "elastogeo", "terminal_width": 78, "catch_exceptions": False}
    shown = CliRunner(env={"NO_COLOR": "1"}).invoke(application(), [*command, "--help"], **as_shown)
    title = " ".join(["elastogeo", *command])
    text = "\n".join(part.rstrip() for part in shown.stdout.strip().splitlines())
    return f"## {title}\n\n```text\n{text}\n```\n"


if __name__ == "__main__":
    PAGE.write_text(reference(), encoding="utf-8")
