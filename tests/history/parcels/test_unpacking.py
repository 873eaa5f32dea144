"""What was sent is laid out or refused by name, and nothing of it lies outside of its folder: a corpus of attacks."""

import re
import stat
import zipfile

import pytest

from elastogeo.errors import FormatError
from elastogeo.history.parcels import unpacking
from elastogeo.history.parcels.unpacking import lay_out, safe_path
from tests.history.parcels.archives import bomb, member, packed, said_larger, with_flag

GOOD = packed([("a/test.toml", b"x = 1\n"), ("a/runs/1.csv", b"1,2\n" * 9)])


def laid(tmp_path, *sent):
    """What becomes of what was sent: the files by path, and the errors."""
    outside = set(tmp_path.rglob("*"))
    folder = tmp_path / "laid"
    files = []
    for n, (name, content) in enumerate(sent):
        place = tmp_path / f"{n}"
        place.write_bytes(content)
        outside.add(place)
        files.append((name, place))
    refused = lay_out(files, folder)
    assert {path for path in tmp_path.rglob("*") if folder not in (path, *path.parents)} == outside
    assert not any(path.is_symlink() for path in folder.rglob("*"))
    found = {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    return found, [one.error for one in refused]


def test_an_archive_and_files_are_laid_out_as_their_sender_has_them(tmp_path):
    found, errors = laid(tmp_path, ("x.zip", GOOD), ("b/test.toml", b"y = 2\n"), ("b\\runs\\2.csv", b"3,4\n"))
    assert errors == []
    assert found == {
        "a/test.toml": b"x = 1\n", "a/runs/1.csv": b"1,2\n" * 9, "b/test.toml": b"y = 2\n", "b/runs/2.csv": b"3,4\n",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("archive", "said"),
    [
        (packed([("../test.toml", b"")]), r"leads upwards \(\.\.\)"),
        (packed([("a/../../test.toml", b"")]), r"leads upwards \(\.\.\)"),
        (packed([("a\\..\\..\\test.toml", b"")]), r"leads upwards \(\.\.\)"),
        (packed([("/etc/cron.d/x", b"")]), "is an absolute path"),
        (packed([("C:\\x", b"")]), "is an absolute path"),
        (packed([("\\\\server\\share\\x", b"")]), "is an absolute path"),
        (packed([("a\nb", b"")]), "is no name of a file that can be kept"),
        (packed([("x" * 300, b"")]), "is no name of a file that can be kept"),
        (packed([("/".join("a" * 30), b"")]), "is no name of a file that can be kept"),
        (packed([(member("a", stat.S_IFLNK | 0o777), b"/etc/passwd")]), "is a link, and no file"),
        (packed([(member("a", stat.S_IFIFO | 0o666), b"")]), "is a link, and no file"),
        (packed([("a/inner.zip", GOOD)]), "is an archive in an archive; unpack it first"),
        (with_flag(GOOD, 1), "is encrypted; make the archive again without a password"),
        (packed([("a", b"x" * 99)], zipfile.ZIP_LZMA), "is compressed in a way that is not read"),
        (packed([(str(n), b"") for n in range(1001)]), "holds more than 1000 members"),
        (said_larger(GOOD, 2**23), "holds more than 1000 members"),
        (packed([("a", b"\0" * 200_000_000)]), "becomes more than 100 times its size"),
        (bomb(900), "cannot be unpacked|two files have this name"),
        (packed([("a", b"1"), ("a/b", b"2")]), "two files have this name, or a file that of a folder|a file has the name"),
        (packed([("a/b", b"2"), ("a", b"1")]), "two files have this name, or a file that of a folder"),
        (GOOD[:-1], "it may be cut off: send it again"),
        (GOOD[: len(GOOD) // 2], "it may be cut off: send it again"),
        (GOOD.replace(b"PK\x05\x06", b"PK\x06\x07" + bytes(16) + b"PK\x05\x06"), "of the 64-bit kind"),
    ],
)  # fmt: skip
def test_a_bad_archive_is_refused_by_name_and_nothing_of_it_is_kept(tmp_path, archive, said):
    found, errors = laid(tmp_path, ("x.zip", archive), ("ok.txt", b"ok"))
    assert found == {"ok.txt": b"ok"}
    assert len(errors) == 1
    assert errors[0].startswith("x.zip")
    assert re.search(said, errors[0])


def test_every_beginning_of_an_archive_and_every_flipped_bit_is_laid_out_whole_or_refused(tmp_path):
    whole = {"a/test.toml": b"x = 1\n", "a/runs/1.csv": b"1,2\n" * 9}
    for n in range(4, len(GOOD), 7):
        place = tmp_path / f"cut{n}"
        place.mkdir()
        found, errors = laid(place, ("x.zip", GOOD[:n]))
        assert (found, len(errors)) == ({}, 1)
    for n in range(0, 8 * len(GOOD), 37):
        flipped = bytearray(GOOD)
        flipped[n // 8] ^= 1 << n % 8
        place = tmp_path / f"bit{n}"
        place.mkdir()
        found, errors = laid(place, ("x.zip", bytes(flipped)))
        assert not errors or found == {}
        assert errors or set(found.values()) <= {*whole.values(), bytes(flipped)}


def test_all_together_may_become_a_gigabyte_only(tmp_path, monkeypatch):
    monkeypatch.setattr(unpacking, "MOST_UNPACKED", 1000)
    found, errors = laid(
        tmp_path, ("a.zip", packed([("a", b"x" * 600)])), ("b.zip", packed([("b", b"y" * 600)])), ("c", b"z")
    )
    assert set(found) == {"a", "c"}
    assert "all becomes more than" in errors[0]


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"\x1f\x8b\x08rest", "is a gzip file; send a zip archive, or the files themselves"),
        (b"7z\xbc\xaf\x27\x1crest", "is a 7-Zip archive"),
        (b"Rar!\x1a\x07rest", "is a RAR archive"),
        (b"x" * 257 + b"ustar" + b"rest", "is a tar archive"),
    ],
)
def test_other_archives_are_refused(tmp_path, content, said):
    found, errors = laid(tmp_path, ("x", content))
    assert found == {}
    assert said in errors[0]


def test_two_files_of_one_name_are_not_laid_over_each_other(tmp_path):
    found, errors = laid(tmp_path, ("a", b"1"), ("a", b"2"))
    assert found == {"a": b"1"}
    assert "two files have this name" in errors[0]


@pytest.mark.parametrize("name", ["..", "a/..", "/a", "//a/b", "\\a", "c:a", "C:\\a", "", "a\0b", "\ud800", "a\u202eb"])
def test_no_name_leads_anywhere_else(name):
    with pytest.raises(FormatError, match=r"absolute path|leads upwards|is no name of a file"):
        safe_path(name)
