"""The files for a shop's server: their syntax, what they call, and the steps of their page in a plain folder."""

from __future__ import annotations

import configparser
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any
from urllib.error import HTTPError

import pytest
import yaml

from elastogeo.cli.doors import every
from tests.web.browsing import read, serving

ROOT = Path(__file__).resolve().parents[2]
DEPLOY = ROOT / "deploy"
UNITS = ("elastogeo.service", "elastogeo-worker.service")
PAGE = (ROOT / "docs" / "deploy.md").read_text(encoding="utf-8")


def unit(name: str) -> configparser.ConfigParser:
    found = configparser.ConfigParser(interpolation=None)
    found.optionxform = str  # type: ignore[assignment,method-assign]
    found.read(DEPLOY / name, encoding="utf-8")
    return found


@pytest.fixture(scope="module")
def compose() -> dict[str, Any]:
    found: dict[str, Any] = yaml.safe_load((DEPLOY / "compose.yaml").read_text(encoding="utf-8"))
    return found


def options_of(command: str) -> str:
    """The help of a command of elastogeo."""
    words = [sys.executable, "-m", "elastogeo", *command.split(), "--help"]
    return subprocess.run(words, capture_output=True, text=True, check=True, env=None).stdout


def test_every_command_of_the_files_is_one_of_the_program(compose: dict[str, Any]) -> None:
    """With options that it has."""
    called = [shlex.split(unit(name)["Service"]["ExecStart"])[1:] for name in UNITS]
    called += [compose["services"][name]["command"] for name in ("pages", "worker")]
    for words in called:
        command = " ".join(word for word in words[:2] if not word.startswith("-"))
        assert command in every()
        known = options_of(command)
        assert [word for word in words if word.startswith("--") and word.partition("=")[0] not in known] == []


@pytest.mark.parametrize("name", UNITS)
def test_a_unit_is_what_systemd_takes(name: str, tmp_path: Path) -> None:
    """The program and the user that it names are of the shop; here others stand in."""
    found = unit(name)
    assert {"Unit", "Service", "Install"} == set(found.sections())
    if shutil.which("systemd-analyze") is None:
        pytest.skip("systemd-analyze, which is not there")
    text = (DEPLOY / name).read_text(encoding="utf-8")
    program = shlex.split(found["Service"]["ExecStart"])[0]
    assert program.startswith("/opt/elastogeo/")
    (tmp_path / name).write_text(text.replace(program, shutil.which("true") or ""), encoding="utf-8")
    for other in set(UNITS) - {name}:
        (tmp_path / other).write_text("[Service]\nExecStart=/bin/true\n", encoding="utf-8")
    done = subprocess.run(["systemd-analyze", "verify", tmp_path / name], capture_output=True, text=True, check=False)
    told = [line for line in done.stderr.splitlines() if name.removesuffix(".service") in line]
    assert (done.returncode, told) == (0, [])


def test_a_word_that_is_none_of_systemd_is_told(tmp_path: Path) -> None:
    """That the check above can fail."""
    if shutil.which("systemd-analyze") is None:
        pytest.skip("systemd-analyze, which is not there")
    wrong = tmp_path / "elastogeo.service"
    wrong.write_text("[Service]\nExecStart=/bin/true\nProtectSystems=strict\n", encoding="utf-8")
    done = subprocess.run(["systemd-analyze", "verify", wrong], capture_output=True, text=True, check=False)
    assert "ProtectSystems" in done.stderr


def test_the_containers_hang_together(compose: dict[str, Any]) -> None:
    services = compose["services"]
    assert set(services) == {"database", "pages", "worker"}
    assert services["pages"]["environment"] == services["worker"]["environment"]
    assert services["pages"]["environment"]["ELASTOGEO_STORE"].startswith("postgresql://elastogeo@database/")
    used = {volume.partition(":")[0] for one in services.values() for volume in one["volumes"]}
    assert used == set(compose["volumes"])
    assert all(port.startswith("127.0.0.1:") for port in services["pages"]["ports"])
    assert (DEPLOY.parent / services["pages"]["build"]["dockerfile"]).is_file()


def test_what_the_containers_are_told_is_what_the_page_says_to_write(compose: dict[str, Any]) -> None:
    asked = set(re.findall(r"\$\{(\w+):\?", (DEPLOY / "compose.yaml").read_text(encoding="utf-8")))
    told = set(re.findall(r"^(\w+)=", PAGE[PAGE.index("`deploy/.env`") :], flags=re.MULTILINE))
    assert asked == told
    assert compose["name"] == "elastogeo"


def test_no_file_names_a_registry_or_holds_a_password() -> None:
    for file in DEPLOY.iterdir():
        text = file.read_text(encoding="utf-8")
        images = re.findall(r"^(?:FROM|\s*image:)\s+(\S+)", text, flags=re.MULTILINE)
        assert [image for image in images if "/" in image] == []
        assert re.findall(r"(?im)^\s*\w*password\w*[:=]\s*[^$\s].*", text) == []


def test_the_steps_of_the_page_lead_to_pages_that_answer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The history, the first administrator by a password from standard input, the server with accounts."""
    block = re.search(r"## In a folder.*?```bash\n(.*?)```", PAGE, flags=re.DOTALL)
    assert block
    *steps, last = [shlex.split(line) for line in block[1].strip().splitlines()]
    monkeypatch.chdir(tmp_path)
    for words in steps:
        subprocess.run(
            [sys.executable, "-m", *words], input="a long enough password\n", capture_output=True, text=True, check=True
        )
    assert last[:4] == ["elastogeo", "serve", "--store", "shop.db"]
    with serving(tmp_path / "shop.db", tmp_path / "log", *last[4:]) as site:
        assert read(f"{site.url}/health")
        assert b"Log in" in read(f"{site.url}/login")
        with pytest.raises(HTTPError, match="401"):
            read(f"{site.url}/")
