"""How a password is kept, and what it costs to guess one."""

from __future__ import annotations

import sys

import pytest
from argon2 import PasswordHasher, extract_parameters
from argon2.profiles import RFC_9106_LOW_MEMORY

from elastogeo.errors import StoreError
from elastogeo.history.people import passwords


def test_it_is_kept_as_argon2id_by_the_profile_of_rfc_9106() -> None:
    kept = passwords.hashed("correct horse battery")
    assert kept.startswith("$argon2id$v=19$m=65536,t=3,p=4$")  # RFC 9106, 4: second recommended option
    assert passwords.fits(kept, "correct horse battery")
    assert not passwords.fits(kept, "correct horse batterx")
    assert not passwords.outdated(kept)
    assert kept != passwords.hashed("correct horse battery")  # a salt of its own


def test_an_unknown_name_costs_what_a_known_one_does(monkeypatch: pytest.MonkeyPatch) -> None:
    """One comparison with the same parameters, whether there is an account, one without a password, or none."""
    kept, compared = passwords.hashed("correct horse battery"), []
    verify = PasswordHasher.verify
    monkeypatch.setattr(PasswordHasher, "verify", lambda self, of, given: compared.append(of) or verify(self, of, given))
    assert not passwords.fits(kept, "something else")
    assert not passwords.fits(None, "something else")
    assert not passwords.fits(None, "the password of nobody")
    assert [extract_parameters(of) for of in compared] == 3 * [extract_parameters(kept)]
    assert extract_parameters(kept) == RFC_9106_LOW_MEMORY


def test_without_the_package_it_is_said_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    passwords._hasher.cache_clear()
    monkeypatch.setitem(sys.modules, "argon2", None)
    with pytest.raises(StoreError, match=r"needs argon2, which is not installed; .*pip install 'elastogeo\[web\]'"):
        passwords.hashed("correct horse battery")
