"""Kinds of job for the tests; importing this registers them."""

from typing import Any

from elastogeo.errors import InputError, StoreError
from elastogeo.history.work import Work, job


@job("count")
def count(work: Work, asked: dict[str, Any]) -> dict[str, Any]:
    for n in range(asked["to"]):
        work.step(f"number {n + 1}", n, asked["to"])
    return {"counted": asked["to"]}


@job("refuse")
def refuse(_work: Work, asked: dict[str, Any]) -> None:
    raise InputError(f"{asked['what']}: is no number; give one")


@job("break")
def break_(_work: Work, _asked: dict[str, Any]) -> None:
    raise ZeroDivisionError("by nothing")


@job("no room")
def no_room(_work: Work, _asked: dict[str, Any]) -> None:
    raise StoreError("there is no room on the disk")


@job("wait")
def wait(work: Work, _asked: dict[str, Any]) -> None:
    """Until it is to end."""
    import time

    for n in range(400):
        work.step(f"look {n}", n, 400)
        time.sleep(0.05)
    raise AssertionError("nobody ended it")
