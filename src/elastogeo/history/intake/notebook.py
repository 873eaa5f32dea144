"""What a watch has done: a line for each test, added as it is done, so that a crash loses one at most."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from elastogeo.errors import StoreError
from elastogeo.history.store import Files


def notebook_of(files: Files, folder: Path, history: str) -> Notebook:
    """The notes of the watch over a folder, beside the raw files; `history` tells one history from the next at its place."""
    name = hashlib.sha256(f"{history}\n{folder}".encode("utf-8", "surrogateescape")).hexdigest()[:16]
    return Notebook(files.folder / "watched" / f"{name}.jsonl")


class Notebook:
    """The notes of a watch over one folder.

    Parameters
    ----------
    file : Path
        Where they are; a last line that was cut off does not count.
    """

    def __init__(self, file: Path) -> None:
        self._file = file
        self._notes: dict[str, tuple[str, str]] = {}
        self._read()

    def knows(self, key: str, state: str, machines: str) -> bool:
        """Whether a test was dealt with in this state; one that did not come in, under the same circumstances."""
        found = self._notes.get(key)
        return found is not None and found[0] == state and found[1] in ("", machines)

    def note(self, key: str, state: str, machines: str, what: str) -> None:
        """Note that a test was dealt with.

        Raises
        ------
        StoreError
            If it cannot be written.
        """
        self._notes[key] = (state, machines)
        line = json.dumps({"test": key, "state": state, "machines": machines, "what": what})
        try:
            self._file.parent.mkdir(parents=True, exist_ok=True)
            with open(self._file, "a", encoding="utf-8") as file:
                file.write(line + "\n")
        except OSError as error:
            raise StoreError(f"{self._file}: {error.strerror}; the watch cannot note what it has done") from None

    def forget(self) -> None:
        """Forget everything: tests that were refused are tried again, those that came in are found known."""
        self._notes.clear()
        self._file.unlink(missing_ok=True)

    def _read(self) -> None:
        try:
            lines = self._file.read_text("utf-8", "replace").split("\n")
        except FileNotFoundError:
            return
        except OSError as error:
            raise StoreError(f"{self._file}: {error.strerror}; check its permissions") from None
        for line in lines:
            try:
                said = json.loads(line)
                self._notes[said["test"]] = (said["state"], said["machines"])
            except (ValueError, KeyError, TypeError):
                continue  # cut off by a crash: that test is looked at again
        if lines[-1]:
            with open(self._file, "a", encoding="utf-8") as file:
                file.write("\n")
