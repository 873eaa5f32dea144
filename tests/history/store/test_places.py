"""Where a history lies, and where it must not."""

from pathlib import Path, PurePosixPath

import pytest

from elastogeo.errors import StoreError
from elastogeo.history.store import open_store, sqlite
from elastogeo.history.store.mounts import network_type, windows_network
from elastogeo.history.store.place import place_of

MOUNTS = """\
/dev/sda1 / ext4 rw,relatime 0 0
tmpfs /tmp tmpfs rw 0 0
nas:/shop /mnt/shop nfs4 rw,vers=4.2 0 0
//server/hall\\0402 /mnt/hall\\0402 cifs rw 0 0
me@host:/ /home/me/far fuse.sshfs rw 0 0
/dev/sdb1 /mnt/shop/local ext4 rw 0 0
portal /run/user/doc fuse.portal rw 0 0
nas:/a /over nfs rw 0 0
/dev/sdc1 /over xfs rw 0 0
"""


@pytest.mark.parametrize(
    ("folder", "kind"),
    [
        ("/var/lib", ""),
        ("/tmp/x", ""),
        ("/mnt/shop", "nfs4"),
        ("/mnt/shop/machines/3", "nfs4"),
        ("/mnt/shopping", ""),  # a name that only begins the same
        ("/mnt/shop/local/x", ""),  # a drive of this computer, mounted within a share
        ("/mnt/hall 2/x", "cifs"),
        ("/home/me/far/x", "fuse.sshfs"),
        ("/run/user/doc", ""),
        ("/over/x", ""),  # the last mount on a place is what is seen
    ],
)
def test_a_network_drive_is_known_by_its_mount(folder: str, kind: str) -> None:
    assert network_type(PurePosixPath(folder), MOUNTS) == kind


def test_a_table_of_mounts_that_says_nothing_names_no_network_drive() -> None:
    assert network_type(PurePosixPath("/x"), "") == ""
    assert network_type(PurePosixPath("/x"), "broken\n\n/dev/sda1 /\n") == ""


@pytest.mark.parametrize(
    ("folder", "kind"),
    [
        (r"\\server\share\x", "network share"),
        ("//server/share/x", "network share"),
        (r"\\?\UNC\server\share", "network share"),
        (r"\\?\C:\x", ""),
        (r"C:\Users\me", ""),
        (r"Z:\shop", "network drive"),
    ],
)
def test_a_network_drive_of_windows_is_known_by_its_name_or_letter(folder: str, kind: str) -> None:
    types = {"C:\\": 3, "Z:\\": 4}
    assert windows_network(folder, types.__getitem__) == kind


def test_a_network_drive_is_refused_with_the_ways_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sqlite, "network_drive", lambda folder: "nfs4" if folder == tmp_path.resolve() else "")
    with pytest.raises(StoreError, match=r"network drive \(nfs4\).*a drive of this computer, or use PostgreSQL"):
        open_store(tmp_path / "history.db", create=True)
    assert list(tmp_path.iterdir()) == []


def test_a_place_is_a_file_or_a_server(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    by_path, by_name, by_url = (place_of(url) for url in (tmp_path / "h.db", "h.db", f"sqlite:///{tmp_path}/h.db"))
    assert by_path.file == by_name.file == by_url.file == tmp_path / "h.db"
    assert by_name.files == tmp_path / "h.db.files"
    assert place_of("sqlite:///h.db").file == tmp_path / "h.db"
    server = place_of("postgresql://anna:geheim@db.shop/elastogeo", files=tmp_path / "raw")
    assert server.server is not None
    assert (server.server.drivername, server.server.password) == ("postgresql+psycopg", "geheim")
    assert server.url == "postgresql://anna:***@db.shop/elastogeo"
    assert server.files == tmp_path / "raw"
    monkeypatch.setenv("ELASTOGEO_FILES", str(tmp_path / "variable"))
    assert place_of("postgresql://db.shop/elastogeo").files == tmp_path / "variable"


@pytest.mark.parametrize(
    ("url", "said"),
    [
        ("", "the history has no name; give a file"),
        ("sqlite://", "keeps nothing once the program ends"),
        ("sqlite:///:memory:", "keeps nothing once the program ends"),
        ("sqlite://h.db", "has three slashes before its name: sqlite:///h.db"),
        ("mysql://me:geheim@host/db", "mysql://host/db: the history does not know 'mysql'"),
        ("postgresql://host:port/db", "write it as postgresql://user@host/database"),
        ("postgresql://host/db", "keeps its raw files in a folder; name it in the variable ELASTOGEO_FILES"),
    ],
)
def test_what_is_no_place_is_refused_without_its_password(url: str, said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ELASTOGEO_FILES", raising=False)
    with pytest.raises(StoreError) as refused:
        place_of(url)
    assert said in str(refused.value)
    assert "geheim" not in str(refused.value)


def test_a_folder_or_a_missing_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match="is a folder; name a file in it"):
        open_store(tmp_path, create=True)
    with pytest.raises(StoreError, match="there is no folder"):
        open_store(tmp_path / "none" / "h.db", create=True)


def test_a_file_that_is_no_history_is_refused_and_left(tmp_path: Path) -> None:
    other = tmp_path / "other.db"
    other.write_bytes(b"not a database, " * 100)
    for create in (False, True):
        with pytest.raises(StoreError, match="is no file of SQLite, or is damaged"):
            open_store(other, create=create)
    assert other.read_bytes() == b"not a database, " * 100


def test_a_database_that_does_not_answer_is_named_without_its_password(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match="cannot be reached") as refused:
        open_store("postgresql://anna:geheim@127.0.0.1:1/shop", files=tmp_path)
    assert "geheim" not in str(refused.value)
