"""Two programs at once, and places that may not be written."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path

import pytest
from sqlalchemy import func, select

from elastogeo.errors import StoreError
from elastogeo.history.intake.machines import add_machine
from elastogeo.history.store import Store, read
from elastogeo.history.store.schema import audit, test
from elastogeo.history.upkeep import back_up, export, verify
from tests.history.intake.small_tests import write_test

CODE = """
import sys
from elastogeo.history.intake.imports import import_test
from elastogeo.history.store import open_store
with open_store(sys.argv[1]) as store:
    for folder in sys.argv[2:]:
        print(import_test(store, folder, machine="Mill 3", who="a program").new)
"""


def test_two_processes_import_the_same_tests_at_once(store: Store, url: str, tmp_path: Path) -> None:
    add_machine(store, "Mill 3", who="the tests")
    folders = [str(write_test(tmp_path / f"{k}", seed=k)) for k in range(4)]
    command = [sys.executable, "-c", CODE, url, *folders]
    children = [subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for _ in range(2)]
    said = [child.communicate() for child in children]
    assert [error for _, error in said] == ["", ""]
    assert " ".join(out for out, _ in said).split().count("True") == 4  # each test was new to one of them
    with read(store) as connection:
        assert connection.execute(select(func.count()).select_from(test)).scalar() == 4
        imports = select(func.count()).select_from(audit).where(audit.c.what == "import")
        assert connection.execute(imports).scalar() == 4
    assert [one.passed for one in verify(store).verdict] == [True] * 8


@pytest.mark.parametrize("kind", ["truncate"])
@pytest.mark.parametrize("code", [errno.EACCES, errno.EROFS])
def test_a_place_that_may_not_be_written_is_named(
    store: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, code: int
) -> None:
    def refuse(*_: object) -> None:
        raise OSError(code, os.strerror(code))

    for copy in (back_up, export):
        with monkeypatch.context() as patch:
            patch.setattr(os, "mkdir", refuse)
            with pytest.raises(StoreError, match=f"copy: {os.strerror(code)}; nothing was kept of it; ask for the right"):
                copy(store, tmp_path / "copy")
    assert not (tmp_path / "copy").exists()
