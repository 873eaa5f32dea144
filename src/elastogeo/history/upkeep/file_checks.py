"""Whether each raw file is there, with the hash and the size that its row says, and which files no row names."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path

from elastogeo.changes import CHANGED, MISSING, NO_STRAY_FILES, RAW_FILES_WHOLE, RESIZED, STRAY, UNREADABLE, StoreFault
from elastogeo.history.store import Files
from elastogeo.history.upkeep.raw_copies import Step

_BLOCK = 2**20
_TOLD = 100


def damaged(files: Files, sizes: dict[str, int], read: list[int], step: Step) -> Iterator[StoreFault]:
    """Raw files that are not as they were written; fills `read` with the size of each that could be read [bytes]."""
    for done, (sha256, size) in enumerate(sizes.items()):
        if done % _TOLD == 0:
            step(f"raw files: {done} of {len(sizes)}")
        path = files.path(sha256)
        subject = f"raw file {sha256}"
        try:
            got, found = _hash_and_size(path)
        except FileNotFoundError:
            yield StoreFault(RAW_FILES_WHOLE, subject, MISSING, str(path))
        except OSError as error:
            yield StoreFault(RAW_FILES_WHOLE, subject, UNREADABLE, error.strerror or str(error))
        else:
            read.append(found)
            if got != sha256:
                yield StoreFault(RAW_FILES_WHOLE, subject, CHANGED, str(path))
            elif found != size:
                yield StoreFault(RAW_FILES_WHOLE, subject, RESIZED, f"{found} bytes; its row says {size}")


def stray(files: Files, named: set[str]) -> Iterator[StoreFault]:
    """Files that no row names; what is only coming in or was sent, and what a watch notes, is not counted."""
    for path in sorted(files.folder.rglob("*")):
        if path.is_dir() or path.relative_to(files.folder).parts[0] in ("incoming", "parcels", "watched"):
            continue
        if path.name not in named or path.parent != files.folder / path.name[:2]:
            yield StoreFault(NO_STRAY_FILES, f"file {path.relative_to(files.folder).as_posix()}", STRAY)


def _hash_and_size(path: Path) -> tuple[str, int]:
    digest, size = hashlib.sha256(), 0
    with open(path, "rb") as file:
        while block := file.read(_BLOCK):
            digest.update(block)
            size += len(block)
    return digest.hexdigest(), size
