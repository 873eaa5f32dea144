"""Whether a folder lies on a network drive, where the locks of SQLite cannot be relied on."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable
from pathlib import Path, PurePosixPath

_NETWORK = {
    "9p", "afs", "beegfs", "ceph", "cifs", "coda", "davfs", "drvfs", "glusterfs", "gpfs", "lustre", "ncpfs", "nfs", "nfs4",
    "prl_fs", "smb3", "smbfs", "vboxsf", "vmhgfs",
}  # fmt: skip
_BY_FUSE = {"ceph", "cifs", "davfs2", "glusterfs", "rclone", "s3fs", "smbnetfs", "sshfs", "vmhgfs-fuse"}
_REMOTE = 4  # GetDriveType: DRIVE_REMOTE


def network_drive(folder: Path) -> str:
    """What kind of network drive a folder lies on; empty for a drive of this computer, or where nothing tells."""
    if os.name == "nt":
        return windows_network(str(folder), _drive_type)
    try:
        mounts = Path("/proc/self/mounts").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
    return network_type(PurePosixPath(folder), mounts)


def network_type(folder: PurePosixPath, mounts: str) -> str:
    """The type of the network file system that a folder lies on, by the table of mounts; empty if it is none.

    Parameters
    ----------
    folder : PurePosixPath
        Absolute, without links.
    mounts : str
        As `/proc/self/mounts`: device, place, type and options on each line; the last mount on a place is what is seen.
    """
    deepest, kind = -1, ""
    for line in mounts.splitlines():
        fields = line.split(" ")
        if len(fields) < 3:
            continue
        place = PurePosixPath(re.sub(r"\\([0-7]{3})", lambda code: chr(int(code[1], 8)), fields[1]))
        if folder.is_relative_to(place) and len(place.parts) >= deepest:
            deepest, kind = len(place.parts), fields[2]
    family, _, member = kind.partition(".")
    return kind if kind in _NETWORK or (family == "fuse" and member in _BY_FUSE) else ""


def windows_network(folder: str, drive_type: Callable[[str], int]) -> str:
    r"""The same on Windows: a share (`\\server\share`), or a letter that stands for one.

    Parameters
    ----------
    folder : str
        Absolute.
    drive_type : callable
        `GetDriveTypeW` of a root such as `Z:\`.
    """
    plain = folder.replace("/", "\\")
    if plain.upper().startswith("\\\\?\\UNC\\"):
        return "network share"
    plain = plain.removeprefix("\\\\?\\")
    if plain.startswith("\\\\"):
        return "network share"
    return "network drive" if drive_type(f"{plain[:2]}\\") == _REMOTE else ""


def _drive_type(root: str) -> int:
    if sys.platform != "win32":
        return 0
    import ctypes

    return int(ctypes.windll.kernel32.GetDriveTypeW(root))
