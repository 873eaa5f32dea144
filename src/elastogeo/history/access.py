"""Who may come in through the pages: accounts and tokens. A part of `History`."""

from __future__ import annotations

from elastogeo.changes import KeptAccounts, KeptTokens
from elastogeo.history import people
from elastogeo.history.store import Store


class Access:
    """What is done with the accounts of an open history.

    Attributes
    ----------
    store : Store
    who : str
        For the audit trail.
    """

    store: Store
    who: str

    def accounts(self) -> KeptAccounts:
        """All accounts, by name."""
        return people.kept_accounts(self.store)

    def add_account(self, name: str, role: str, password: str | None = None) -> None:
        """Make an account; without a password it has tokens only.

        Raises
        ------
        InputError
            If there is one of this name, or name, role or password is none.
        """
        people.add_account(self.store, name, role, password, who=self.who)

    def set_role(self, name: str, role: str) -> None:
        """Make a person reader, engineer or administrator; the last administrator stays one."""
        people.set_role(self.store, name, role, who=self.who)

    def set_password(self, name: str, password: str) -> None:
        """Give a person another password; all sessions of the person end."""
        people.set_password(self.store, name, password, who=self.who)

    def switch_account(self, name: str, on: bool, why: str = "") -> None:
        """Switch an account off, which ends its sessions and tokens, or on; the last administrator stays on."""
        people.switch_account(self.store, name, on, who=self.who, why=why)

    def tokens(self, owner: str | None = None) -> KeptTokens:
        """The tokens of a person, or all."""
        return people.kept_tokens(self.store, owner)

    def make_token(self, owner: str, purpose: str) -> people.MadeToken:
        """Make a token, with which a program comes in as its owner; it is seen this once."""
        return people.make_token(self.store, owner, purpose, who=self.who)

    def end_token(self, number: int, owner: str | None = None) -> None:
        """End a token; with an owner, only one of theirs."""
        people.end_token(self.store, number, who=self.who, owner=owner)
