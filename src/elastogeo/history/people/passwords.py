"""Passwords: what is asked of one, and how it is kept: Argon2id, by the profile of RFC 9106 for 64 MiB and 3 passes."""

from __future__ import annotations

import unicodedata
from functools import cache
from typing import TYPE_CHECKING

from elastogeo.errors import InputError
from elastogeo.history.extra import needs_history_extra

if TYPE_CHECKING:
    from argon2 import PasswordHasher

SHORTEST, LONGEST = 12, 256
"""Characters of a password. The longest is a limit on work, not on safety."""
_FEWEST = 5  # different characters: `aaaaaaaaaaaa` is none


def check_password(password: str, name: str) -> None:
    """Refuse a password that is soon guessed. No message holds what was given.

    Raises
    ------
    InputError
        If it is too short, too long, the account's name, or of few characters.
    """
    plain = _plain(password)
    if len(plain) < SHORTEST:
        raise InputError(f"the password has {len(plain)} characters; take at least {SHORTEST}: a few words are easy to keep")
    if len(plain) > LONGEST:
        raise InputError(f"the password has {len(plain)} characters; take at most {LONGEST}")
    if len(set(plain)) < _FEWEST:
        raise InputError(f"the password has {len(set(plain))} different characters; take at least {_FEWEST}")
    if name.casefold() in plain.casefold() and len(name) * 2 > len(plain):
        raise InputError("the password is the account's name; take another")


def hashed(password: str) -> str:
    """As it is kept, with its salt and parameters."""
    return _hasher().hash(_plain(password))


def fits(kept: str | None, password: str) -> bool:
    """Whether a password is the one that was kept.

    It takes the same time if there is none to compare with, so that nobody learns from it which accounts there are.
    """
    from argon2.exceptions import InvalidHashError, VerificationError

    plain = _plain(password[: LONGEST + 1])
    try:
        return _hasher().verify(kept or _nobodys(), plain) and kept is not None and len(password) <= LONGEST
    except (VerificationError, InvalidHashError):
        return False


def outdated(kept: str) -> bool:
    """Whether it was kept with parameters of another time."""
    return _hasher().check_needs_rehash(kept)


def _plain(password: str) -> str:
    """The same characters however a keyboard composes them (NIST SP 800-63B, 5.1.1.2)."""
    return unicodedata.normalize("NFKC", password).encode("utf-8", "replace").decode()


@cache
def _hasher() -> PasswordHasher:
    with needs_history_extra():
        from argon2 import PasswordHasher
        from argon2.profiles import RFC_9106_LOW_MEMORY

    return PasswordHasher.from_parameters(RFC_9106_LOW_MEMORY)


@cache
def _nobodys() -> str:
    """What a password is compared with where there is no account."""
    return _hasher().hash("the password of nobody")
