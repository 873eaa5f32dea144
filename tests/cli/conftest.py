"""What the tests of the commands share."""

import sys

import pytest

from elastogeo.cli import main


@pytest.fixture
def elastogeo(monkeypatch, capsys):
    """Run a command line in this process: its exit code, standard output and standard error."""

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["elastogeo", *map(str, arguments)])
        code = main()
        out, err = capsys.readouterr()
        return code, out, err

    return run
