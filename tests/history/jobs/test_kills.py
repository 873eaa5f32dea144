"""A server and a worker that are killed in the middle of uploads and analyses: nothing is lost, nothing is double."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

KILLS = 10
"""On each of three databases."""

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = Path(__file__).with_name("killed_server.py")


def killed(url, folder, kills):
    above = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])}
    command = [sys.executable, str(PROGRAM), url, str(folder), str(kills), "1"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, env=above)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return json.loads(done.stdout)


@pytest.mark.skipif(sys.platform == "win32", reason="forks, and sends SIGKILL")
def test_a_server_and_a_worker_that_are_killed_at_random_instants(url, tmp_path):
    found = killed(url, tmp_path, KILLS)
    assert found["wrong"] == []
    assert found["broken"] or found["confirmed_before"] < KILLS  # some were killed in the middle of something


@pytest.mark.nightly
@pytest.mark.skipif(sys.platform == "win32", reason="forks, and sends SIGKILL")
def test_a_server_and_a_worker_that_are_killed_three_hundred_times(url, tmp_path):
    assert killed(url, tmp_path, 300)["wrong"] == []
