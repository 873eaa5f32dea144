"""What the pages need beyond the core, and what to say when it is not there."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from elastogeo.errors import InputError

_NEEDED = ("fastapi", "starlette", "uvicorn", "jinja2", "argon2", "python_multipart", "sqlalchemy")


class MissingWebExtraError(InputError):
    """The pages were asked for and need packages that are not installed."""


@contextmanager
def needs_web_extra() -> Iterator[None]:
    """Run imports that need the extra `web`.

    Raises
    ------
    MissingWebExtraError
        If FastAPI, uvicorn, Jinja2, argon2-cffi or python-multipart is not installed.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        missing = (error.name or "").partition(".")[0]
        if missing not in _NEEDED:
            raise
        raise MissingWebExtraError(
            f"the pages need {missing}, which is not installed; install it with: pip install 'elastogeo[web]'"
        ) from error
