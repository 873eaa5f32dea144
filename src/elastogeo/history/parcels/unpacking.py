"""What was sent, laid out as files: archives unpacked, each file under the path that its sender gave it.

Nothing that an archive says of itself is believed: bytes are counted as they come out. A name leads nowhere but into the
folder; a link, an archive in an archive, an encrypted member is refused with its name.
"""

from __future__ import annotations

import errno
import os
import stat
import struct
import zipfile
import zlib
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import BinaryIO

from elastogeo.errors import FormatError

MOST_UNPACKED = 10**9
"""Bytes that a parcel may become."""
MOST_RATIO = 100
"""Times its size that an archive may become, beyond the first `_FREE` bytes."""
MOST_MEMBERS = 1000
_FREE = 10**6
_DEEPEST = 20
_LONGEST = 255
_DIRECTORY = 2**22
"""Bytes of the directory of an archive that is read: a thousand members need far less."""
_BLOCK = 2**18
_OTHERS = {
    b"\x1f\x8b": "a gzip file", b"7z\xbc\xaf\x27\x1c": "a 7-Zip archive", b"Rar!\x1a\x07": "a RAR archive",
    b"\xfd7zXZ\x00": "an xz file", b"BZh": "a bzip2 file", b"(\xb5/\xfd": "a Zstandard file",
}  # fmt: skip
_SHEETS = (".xlsx", ".ods", ".docx", ".odt")
"""Documents that are archives inside: they are no tests, and not unpacked."""
_BAD = (
    zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, ValueError, struct.error, IndexError,
    OverflowError,
)  # fmt: skip

Told = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Refused:
    """A file that was not laid out, and why."""

    name: str
    error: str


def lay_out(sent: Iterable[tuple[str, Path]], folder: Path, told: Told = lambda _: None) -> tuple[Refused, ...]:
    """Lay out what was sent.

    Parameters
    ----------
    sent : iterable of (name, file)
        As its sender called it, and where it is.
    folder : Path
        It must not exist.
    told : callable
        Is told what is laid out, often.

    Returns
    -------
    tuple of Refused
        What was not laid out; of a refused archive nothing is.
    """
    folder.mkdir()
    refused, left = [], [MOST_UNPACKED]
    for name, file in sent:
        told(f"unpacking {PurePosixPath(name).name}")
        try:
            if zipfile_of(file) and not name.lower().endswith(_SHEETS):
                _unpack(name, file, folder, left, told)
            else:
                _place(name, file, folder, left)
        except FormatError as error:
            refused.append(Refused(name, str(error)))
    return tuple(refused)


def zipfile_of(file: Path) -> bool:
    """Whether a file is a zip archive, by its content."""
    with open(file, "rb") as opened:
        return opened.read(4) in (b"PK\x03\x04", b"PK\x05\x06", b"PK\x07\x08")


def safe_path(name: str) -> PurePosixPath:
    """The path that a sender gave a file, from the folder of the parcel.

    Raises
    ------
    FormatError
        If it is absolute, leads upwards, or is no path.
    """
    path = PurePosixPath(name.replace("\\", "/"))
    windows = PureWindowsPath(name)
    if path.is_absolute() or windows.drive or windows.root:
        raise FormatError(f"{name[:80]!r} is an absolute path; send the folder of the test, with paths from there")
    if ".." in path.parts:
        raise FormatError(f"{name[:80]!r} leads upwards (..); send the folder above, with paths from there")
    odd = any(not part.isprintable() or len(part.encode("utf-8", "replace")) > _LONGEST for part in path.parts)
    if not path.parts or odd or len(path.parts) > _DEEPEST or not _is_text(name):
        raise FormatError(f"{name[:80]!r} is no name of a file that can be kept; rename it")
    return path


def _is_text(name: str) -> bool:
    try:
        name.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return True


def _place(name: str, file: Path, folder: Path, left: list[int]) -> None:
    """Lay out a file that is no archive."""
    with open(file, "rb") as source:
        head = source.read(512)
        other = next((words for magic, words in _OTHERS.items() if head.startswith(magic)), "")
        if other or head[257:262] == b"ustar":
            raise FormatError(f"{name}: is {other or 'a tar archive'}; send a zip archive, or the files themselves")
        source.seek(0)
        _write(source, name, folder / safe_path(name), left, [], None, 0)


def _unpack(name: str, file: Path, folder: Path, left: list[int], told: Told) -> None:
    """Lay out an archive: all of it or nothing."""
    size = file.stat().st_size
    written: list[Path] = []
    came = [0]
    try:
        with open(file, "rb") as opened:
            _check_directory(opened, name, size)
            with zipfile.ZipFile(opened) as archive:
                members = [one for one in archive.infolist() if not one.is_dir()]
                if len(archive.infolist()) > MOST_MEMBERS:
                    raise FormatError(f"{name}: holds more than {MOST_MEMBERS} members; send the tests in several archives")
                targets = {one: folder / _checked(one, name) for one in members}
                for k, (member, target) in enumerate(targets.items()):
                    told(f"unpacking {k + 1} of {len(targets)}")
                    with archive.open(member) as source:
                        _write(source, f"{name}, {member.filename}", target, left, written, came, size)  # type: ignore[arg-type]
    except BaseException as error:
        for path in written:
            path.unlink(missing_ok=True)
        left[0] += came[0]
        if isinstance(error, _BAD) or (isinstance(error, OSError) and error.errno == errno.EINVAL):  # it points nowhere
            said = str(error).strip("'\"")
            raise FormatError(f"{name}: cannot be unpacked ({said[:200]}); make the archive again, and send it") from error
        raise


def _checked(member: zipfile.ZipInfo, name: str) -> PurePosixPath:
    """The path of a member that may be unpacked."""
    said = f"{name}, {member.filename[:80]}"
    kind = stat.S_IFMT(member.external_attr >> 16)
    if kind not in (0, stat.S_IFREG):
        raise FormatError(f"{said}: is a link, and no file; put the file itself into the archive")
    if member.flag_bits & 0x41:
        raise FormatError(f"{said}: is encrypted; make the archive again without a password")
    if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise FormatError(f"{said}: is compressed in a way that is not read; make an ordinary zip archive (deflate)")
    try:
        return safe_path(member.filename)
    except FormatError as error:
        raise FormatError(f"{name}: {error}") from None


def _check_directory(file: BinaryIO, name: str, size: int) -> None:
    """Refuse an archive whose directory is larger than that of any archive that is taken, before it is read."""
    tail = min(size, 65_557)
    file.seek(size - tail)
    data = file.read(tail)
    at = len(data) - 22 if data[-22:-18] == b"PK\x05\x06" and data[-2:] == b"\0\0" else data.rfind(b"PK\x05\x06")
    if at < 0 or at + 22 > len(data):
        raise FormatError(f"{name}: cannot be unpacked (it has no directory at its end); it may be cut off: send it again")
    (directory,) = struct.unpack_from("<L", data, at + 12)
    if data[max(at - 20, 0) : at].startswith(b"PK\x06\x07"):
        raise FormatError(f"{name}: is a zip archive of the 64-bit kind; make an ordinary one, or send its files in parts")
    if directory > _DIRECTORY:
        raise FormatError(f"{name}: holds more than {MOST_MEMBERS} members; send the tests in several archives")
    file.seek(0)


def _write(
    source: BinaryIO, said: str, target: Path, left: list[int], written: list[Path], came: list[int] | None, packed: int
) -> None:
    """Write a file, its bytes counted as they come; `came` counts those of its archive, of `packed` bytes."""
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        with open(target, "xb") as into:
            written.append(target)
            first = True
            while block := source.read(_BLOCK):
                if first and came is not None and block.startswith(b"PK\x03\x04") and target.suffix.lower() not in _SHEETS:
                    raise FormatError(f"{said}: is an archive in an archive; unpack it first")
                first = False
                left[0] -= len(block)
                if came is not None:
                    came[0] += len(block)
                    if came[0] > _FREE + MOST_RATIO * packed:
                        raise FormatError(
                            f"{said}: becomes more than {MOST_RATIO} times its size; send the files themselves"
                        )
                if left[0] < 0:
                    raise FormatError(f"{said}: all becomes more than {MOST_UNPACKED // 10**9} GB; send it in several parts")
                into.write(block)
    except FileExistsError:
        raise FormatError(f"{said}: two files have this name, or a file that of a folder; rename one") from None
    except NotADirectoryError:
        raise FormatError(f"{said}: a file has the name of its folder; rename one") from None
    if os.name == "posix":
        os.chmod(target, 0o600)
