"""Passwords that are kept in a millisecond: what Argon2id costs is tested once, by itself."""

from __future__ import annotations

import pytest


@pytest.fixture
def quick_passwords(monkeypatch: pytest.MonkeyPatch) -> None:
    from argon2 import PasswordHasher

    from elastogeo.history.people import passwords

    quick = PasswordHasher(time_cost=1, memory_cost=8, parallelism=1)
    monkeypatch.setattr(passwords, "_hasher", lambda: quick)
    passwords._nobodys.cache_clear()
