"""Raw files copied from one history's folder to another's, each with the hash of its name."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from elastogeo.errors import StoreError
from elastogeo.history.store import Files

Step = Callable[[str], None]
"""Takes what is going on, for a person who waits."""
_AT_ONCE = 100


def silent(_: str) -> None:
    """Nobody waits."""


def copy_raw(source: Files, target: Files, hashes: Sequence[str], step: Step) -> int:
    """Copy the files of these hashes; their size [bytes].

    Raises
    ------
    StoreError
        If one is missing or damaged, or cannot be written.
    """
    target.make()
    done, size = 0, 0
    for first in range(0, len(hashes), _AT_ONCE):
        some = hashes[first : first + _AT_ONCE]
        paths = [source.path(sha256) for sha256 in some]
        for path in paths:
            if not path.is_file():
                raise StoreError(f"{path}: is missing; put it back from a backup, then repeat")
        for path, wanted, got in zip(paths, some, target.put_all(paths), strict=True):
            if got != wanted:
                if got not in hashes:
                    target.path(got).unlink(missing_ok=True)
                raise StoreError(
                    f"{path}: was changed: its content no longer has the hash of its name; put it back from a backup"
                )
            size += target.path(wanted).stat().st_size
        done += len(some)
        step(f"raw files: {done} of {len(hashes)}")
    return size
