"""An import that is killed at any instant loses nothing that it acknowledged, leaves nothing half, and is made up for."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from sqlalchemy import func, select

from elastogeo.history.intake.machines import add_machine
from elastogeo.history.store import read
from elastogeo.history.store.schema import analysis, test

KILLS = 10
"""On each of three databases."""

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = Path(__file__).with_name("killed_imports.py")


def killed(url, store, folder, kills, *more):
    add_machine(store, "Mill 3", who="A. Nobody")
    command = [sys.executable, str(PROGRAM), url, str(folder), str(kills), "1", *more]
    above = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])}
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, env=above)
    assert done.stderr == ""
    found = json.loads(done.stdout)
    assert found["wrong"] == []
    assert len(set(found["again"])) == len(found["again"]) == 2 * (kills + 1)
    assert set(found["acknowledged"]) <= set(found["again"])
    with read(store) as connection:
        assert connection.execute(select(func.count()).select_from(test)).scalar() == 2 * (kills + 1)
    return found


@pytest.mark.skipif(sys.platform == "win32", reason="forks, and sends SIGKILL")
def test_an_import_that_is_killed_at_random_instants(url, store, tmp_path):
    found = killed(url, store, tmp_path, KILLS)
    assert len(found["acknowledged"]) < 2 * (KILLS + 1)  # not all came through


@pytest.mark.nightly
@pytest.mark.skipif(sys.platform == "win32", reason="forks, and sends SIGKILL")
def test_an_import_with_its_analysis_that_is_killed_a_thousand_times(url, store, tmp_path):
    killed(url, store, tmp_path, 334, "whole")
    with read(store) as connection:
        assert connection.execute(select(func.count()).select_from(analysis)).scalar() == 2 * 335
