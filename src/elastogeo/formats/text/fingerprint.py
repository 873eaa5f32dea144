"""What a file held when it was read: the hash by which a report can be held against its data."""

from __future__ import annotations

import hashlib
from pathlib import Path

from elastogeo.formats.text.files_read import may_open


def sha256_of(path: Path) -> str:
    """SHA-256 of a file, or of a recording: of the names and hashes of the files in its folder.

    Returns
    -------
    str
        64 hexadecimal digits, as `sha256sum` prints them.
    """
    may_open(path)
    if path.is_dir():
        parts = (f"{sha256_of(part)}  {part.name}\n" for part in sorted(path.iterdir()) if part.is_file())
        return hashlib.sha256("".join(parts).encode()).hexdigest()
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
