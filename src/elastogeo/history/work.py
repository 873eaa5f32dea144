"""Kinds of long work: what a job may be asked to do, each in one file that registers itself.

A kind is a function in a file whose name ends in `_job.py`, in a wing of this room. It is found and registered by itself.
A complete one, `jobs/toy_job.py` of the tests::

    from elastogeo.history.work import Work, job


    @job("count")
    def count(work: Work, asked: dict[str, Any]) -> dict[str, Any]:
        for n in range(asked["to"]):
            work.step(f"number {n + 1}", n, asked["to"])
        return {"counted": asked["to"]}

What the contract asks:

* it may be killed at any instant and is then run again from its beginning: done twice, the history holds the same as done
  once. What it keeps, it keeps in whole transactions; what it finds done already, it leaves;
* it calls `work.step` between its steps, at least once a second if it can: there it ends (by `JobEnded`, which it lets pass)
  when it was cancelled, or when its worker is to stop; and that it gets on is what keeps it from being given up;
* what it returns is kept as the job's result: plain JSON types, among them `errors`, a list of sentences, if parts failed;
* what it raises as an `ElastogeoError` is told to the person who asked as it stands; a `StoreError` is tried again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

from elastogeo.errors import InputError
from elastogeo.history.store import Store

Kind = Callable[["Work", dict[str, Any]], "dict[str, Any] | None"]


class JobEnded(BaseException):
    """A job ends here, between two steps: it was cancelled, or its worker stops. Not for a kind to catch."""


@dataclass(frozen=True, slots=True)
class Work:
    """What a kind of job is given to work with.

    Attributes
    ----------
    store : Store
    who : str
        Who asked for it, for the audit trail.
    step : callable
        `step(text, done=0, total=0)`: what is done now, in words, and how much of it is; costs nothing.
    cancelled : callable
        `cancelled()`: whether it is to end; `step` asks by itself.
    """

    store: Store
    who: str
    step: Callable[..., None]
    cancelled: Callable[[], bool]


_KINDS: dict[str, Kind] = {}


def job(name: str) -> Callable[[Kind], Kind]:
    """Register a kind of job under a name."""

    def register(kind: Kind) -> Kind:
        _KINDS[name] = kind
        return kind

    return register


def kind_named(name: str) -> Kind:
    """The kind of job of this name.

    Raises
    ------
    InputError
        If there is none.
    """
    if name not in _KINDS:
        _find()
    if name not in _KINDS:
        raise InputError(f"there is no job of the kind {name!r}; there are {', '.join(sorted(_KINDS))}")
    return _KINDS[name]


def _find() -> None:
    """Import the files of kinds of all wings."""
    room = __name__.rpartition(".")[0]
    for wing in iter_modules(import_module(room).__path__, f"{room}."):
        if wing.ispkg:
            for file in iter_modules(import_module(wing.name).__path__, f"{wing.name}."):
                if file.name.endswith("_job"):
                    import_module(file.name)
