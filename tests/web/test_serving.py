"""What `elastogeo serve` says before it serves: one clear error, and nothing made."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner

from elastogeo.cli.app import application
from elastogeo.errors import InputError
from elastogeo.web import Settings, serve
from elastogeo.web.serving import listening


@pytest.fixture
def taken() -> Iterator[int]:
    with socket.create_server(("127.0.0.1", 0)) as other:
        yield int(other.getsockname()[1])


def test_a_port_that_another_program_has_is_said_before_anything_is_made(tmp_path: Path, taken: int) -> None:
    said: list[str] = []
    with pytest.raises(InputError, match=f"port {taken} of 127.0.0.1 cannot be had: address already in use; give another"):
        serve(Settings(tmp_path / "h.db", port=taken), said.append)
    assert said == []
    assert list(tmp_path.iterdir()) == []


def test_an_address_of_another_computer_is_refused() -> None:
    with (
        pytest.raises(InputError, match=r"of 192\.0\.2\.7 cannot be had: .*an address of this computer with --host"),
        listening("192.0.2.7", 8347),
    ):
        pass


def test_a_port_is_held_and_given_back(taken: int) -> None:
    with listening("127.0.0.1", 0) as sockets:
        assert [one.proto for one in sockets] == [socket.IPPROTO_TCP], "else each answer waits 40 ms for a packet to fill"
        assert sockets[0].getsockname()[1] not in (0, taken)
    assert sockets[0].fileno() == -1


@pytest.mark.parametrize("prefix", ["/a b", "/el/../x", "/a;Secure", "/a//b", "/..", "elastogeo", "/a/", "/é"])
def test_a_prefix_that_is_no_path_is_refused(prefix: str) -> None:
    with pytest.raises(InputError, match="is no beginning of an address; give letters"):
        Settings("h.db", prefix=prefix)


@pytest.mark.parametrize("prefix", ["", "/elastogeo", "/shop-2/~el_1.x"])
def test_a_prefix_that_is_a_path_is_taken(prefix: str) -> None:
    assert Settings("h.db", prefix=prefix).prefix == prefix


def test_the_demo_takes_no_store_of_somebody(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(application("serve"), ["serve", "--demo", "--store", "mine.db"])
    assert isinstance(done.exception, InputError)
    assert "--demo shows a history of its own" in str(done.exception)
    assert list(tmp_path.iterdir()) == []
