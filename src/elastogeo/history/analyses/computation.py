"""From the raw files of a test to what is kept of its analysis. No database: another process may do it.

The settings say everything that changes the numbers: the verb, the question, where draws begin. With the hashes of the files
and the version of the software they determine the document; on another platform to 1e-12 of each number.
"""

from __future__ import annotations

import hashlib
import os
import platform
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any, TypeVar

import numpy as np
import scipy

from elastogeo.changes import Indicator, indicators_of, signatures_of
from elastogeo.errors import ElastogeoError
from elastogeo.history.analyses.raw import RawFile, laid_out
from elastogeo.history.analyses.verbs import SEED, asked_of
from elastogeo.history.store import Files
from elastogeo.history.store.columns import canonical
from elastogeo.report import view_of
from elastogeo.result import Result

Told = TypeVar("Told")

FAULTS = (ArithmeticError, AssertionError, AttributeError, LookupError, TypeError, ValueError)
"""What a fault of the program raises; all else (memory, disk) says nothing of the test and is not kept."""


@dataclass(frozen=True, slots=True)
class Computed:
    """What an analysis says.

    Attributes
    ----------
    settings : mapping
        `verb`, `question`, `seed`; `made_with`: interpreter, numpy, scipy, platform, threads, which change last digits only.
    inputs_sha256 : str
        Of the files' paths and hashes and the settings without `made_with`.
    document : mapping or None
        That of the result's view; None after an error.
    supported : bool
    indicators : tuple of Indicator
    signatures : mapping or None
        How faults of the machine's components move the indicators, as plain values.
    error : str or None
    """

    settings: dict[str, Any]
    inputs_sha256: str
    document: dict[str, Any] | None
    supported: bool
    indicators: tuple[Indicator, ...]
    signatures: dict[str, Any] | None
    error: str | None

    @property
    def document_sha256(self) -> str | None:
        """Of the document as it is kept."""
        return None if self.document is None else sha256_of(self.document)


def computed(files: Files, raw: Sequence[RawFile], attempt: int = 1) -> Computed:
    """Analyse a test: the verb that fits its instrument, from its raw files.

    Parameters
    ----------
    files : Files
        Of the store.
    raw : sequence of RawFile
    attempt : int
        The second attempt follows an error that the same version no longer makes: a package is installed now.

    Raises
    ------
    StoreError
        If a raw file is missing or damaged. An error of the analysis itself is returned, not raised.
    """
    settings: dict[str, Any] = {"verb": "", "question": {}, "seed": SEED, **({"attempt": attempt} if attempt > 1 else {})}
    asked, told, error = ask_again(
        files, raw, lambda result: (view_of(result), indicators_of(result), signatures_of(result))
    )
    settings |= asked
    whole = settings | {"made_with": made_with()}
    if told is None:
        return Computed(whole, inputs_of(raw, settings), None, False, (), None, error)
    view, found, signatures = told
    known = tuple(one for one in found if isfinite(one.value))
    moved = None if signatures is None else signatures.document()
    return Computed(whole, inputs_of(raw, settings), dict(view.document), view.supported, known, moved, None)


def ask_again(
    files: Files, raw: Sequence[RawFile], take: Callable[[Result], Told]
) -> tuple[dict[str, Any], Told | None, str]:
    """Ask a test again, from its raw files, what its verb asks.

    Parameters
    ----------
    files : Files
        Of the store.
    raw : sequence of RawFile
    take : callable
        What is wanted of the result; the files are there while it is asked.

    Returns
    -------
    dict
        The verb and the question, as far as they are known.
    object or None
        What was wanted; None after an error.
    str
        The error, without paths of this computer; empty if there was none.

    Raises
    ------
    StoreError
        If a raw file is missing or damaged.
    """
    settings: dict[str, Any] = {}
    with laid_out(files, raw) as folder:
        try:
            asked = asked_of(folder, [file.path for file in raw])
            settings = {"verb": asked.verb, "question": asked.question}
            return settings, take(asked.answer()), ""
        except ElastogeoError as caught:
            error = str(caught)
        except FAULTS as caught:
            error = f"a fault of elastogeo; report it with this test: {type(caught).__name__}: {caught}"
        return settings, None, error.replace(f"{folder}{os.sep}", "").replace(str(folder), "the test")


def inputs_of(raw: Sequence[RawFile], settings: dict[str, Any]) -> str:
    """Hash of all that an analysis is made from, but the software."""
    return sha256_of({"files": {file.path: file.sha256 for file in raw}, "settings": settings})


def sha256_of(document: Any) -> str:
    """Hash of a document as it is kept."""
    return hashlib.sha256(canonical(document).encode()).hexdigest()


def made_with() -> dict[str, str]:
    """What changes the last digits of a number, and nothing more: where the same bits come out, this is the same."""
    return {
        "python": platform.python_version(),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "platform": f"{sys.platform} {platform.machine()}",
        "threads": next(filter(None, map(os.environ.get, ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"))), "all"),
    }
