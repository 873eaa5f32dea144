"""The one place where files are written: whole, or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from elastogeo.errors import FormatError


def write_whole(contents: Mapping[Path, bytes]) -> tuple[Path, ...]:
    """Write a set of files: all of them, or none if it fails or is interrupted on the way.

    Each is written under a temporary name in its folder and renamed when all are complete, so that a reader never sees
    half a file; what was there before is replaced by the rename. Folders are made.

    Parameters
    ----------
    contents : mapping of Path to bytes

    Returns
    -------
    tuple of Path
        The files, in their order.

    Raises
    ------
    FormatError
        If one of them cannot be written: no space, no permission.
    """
    made, partial, placed = [], {}, []
    try:
        for path, content in contents.items():
            made += _folders_made_for(path)
            handle, name = tempfile.mkstemp(prefix=f".{path.name}.", suffix=".part", dir=path.parent)
            partial[path] = Path(name)
            with os.fdopen(handle, "wb") as file:
                file.write(content)
            Path(name).chmod(_permissions())
        for path, part in partial.items():
            if not path.exists():
                placed.append(path)
            part.replace(path)
    except BaseException as error:
        for left in (*partial.values(), *placed):
            with suppress(OSError):
                left.unlink(missing_ok=True)
        for folder in reversed(made):
            with suppress(OSError):
                folder.rmdir()
        if isinstance(error, OSError):
            raise FormatError(
                f"{path}: cannot be written ({error.strerror}), and none of the files beside it was; nothing was changed"
            ) from None
        raise
    return tuple(contents)


def _folders_made_for(path: Path) -> list[Path]:
    """The folders above a file that were not there, and are now, outermost first."""
    missing = [folder for folder in path.parents if not folder.exists()][::-1]
    path.parent.mkdir(parents=True, exist_ok=True)
    return missing


def _permissions() -> int:
    """Those that a new file gets; a temporary one is its owner's alone."""
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
