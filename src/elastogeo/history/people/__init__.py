"""Who may come in through the pages: accounts with their roles, sessions, tokens. Passwords are kept as Argon2id only.

Of a session and of a token only the SHA-256 is kept: whoever reads the database cannot come in with what is in it.
"""

from elastogeo.history.people.accounts import (
    ROLES,
    add_account,
    check_reachable,
    has_accounts,
    kept_accounts,
    set_password,
    set_role,
    switch_account,
)
from elastogeo.history.people.entering import Person, log_in, person_of_session, person_of_token
from elastogeo.history.people.sessions import ABSOLUTE, IDLE, end_session
from elastogeo.history.people.tokens import MadeToken, end_token, kept_tokens, make_token

__all__ = [
    "ABSOLUTE",
    "IDLE",
    "ROLES",
    "MadeToken",
    "Person",
    "add_account",
    "check_reachable",
    "end_session",
    "end_token",
    "has_accounts",
    "kept_accounts",
    "kept_tokens",
    "log_in",
    "make_token",
    "person_of_session",
    "person_of_token",
    "set_password",
    "set_role",
    "switch_account",
]
