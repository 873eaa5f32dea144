"""What drawing and page writing need beyond the core, and what to say when it is not there."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from elastogeo.errors import InputError

_EXTRA = ("matplotlib", "jinja2", "typst")


class MissingExtraError(InputError):
    """Something was to be drawn or written that needs packages which are not installed."""


@contextmanager
def needs_report_extra() -> Iterator[None]:
    """Run imports that need the extra `report`.

    Raises
    ------
    MissingExtraError
        If matplotlib, jinja2 or typst is not installed.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        missing = (error.name or "").partition(".")[0]
        if missing not in _EXTRA:
            raise
        raise MissingExtraError(
            f"the report needs {missing}, which is not installed; install it with: pip install 'elastogeo[report]'"
        ) from error
