"""How often a password may be tried: ever more slowly, by name and by address.

It is kept in memory, of the last thousands of names: a restart forgets it, and whoever guesses finds the next password as
slow to compare as the one before.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import ceil
from threading import BoundedSemaphore, Lock
from time import monotonic

from elastogeo.errors import InputError

FREE_BY_NAME, FREE_BY_ADDRESS = 5, 20
"""Failures in a row that cost nothing. A shop may share one address."""
LONGEST = 900.0
"""Seconds that one waits at most, and after which it is as if nothing had been."""
_KEPT = 10_000
_AT_ONCE, _IN_ALL = 2, 8
"""Passwords that are compared at once, and attempts that are taken up: each holds a thread that others need for pages."""
_PAUSE = 2


class TooOften(InputError):  # noqa: N818
    """A password was tried too often.

    Attributes
    ----------
    seconds : int
        To wait.
    """

    def __init__(self, seconds: int) -> None:
        super().__init__(f"Too many attempts to log in: wait {seconds} s, then try again.")
        self.seconds = seconds


class Throttle:
    """Who failed how often, and when last; and how many passwords are compared at once.

    Parameters
    ----------
    clock : callable
        Gives the time [s].
    """

    def __init__(self, clock: Callable[[], float] = monotonic) -> None:
        self._clock, self._lock = clock, Lock()
        self._failed: OrderedDict[tuple[str, str], tuple[int, float]] = OrderedDict()
        self._homes: OrderedDict[tuple[str, str], None] = OrderedDict()
        self._taken_up = 0
        self.comparing = BoundedSemaphore(_AT_ONCE)  # each takes 64 MiB

    @contextmanager
    def attempt(self) -> Iterator[None]:
        """Take up an attempt while this lasts.

        Raises
        ------
        TooOften
            If there are many already.
        """
        with self._lock:
            if self._taken_up >= _IN_ALL:
                raise TooOften(_PAUSE)
            self._taken_up += 1
        try:
            yield
        finally:
            with self._lock:
                self._taken_up -= 1

    def check(self, name: str, address: str) -> None:
        """Refuse who must wait; else it counts as a failure until `succeeded`, so that many at once are none too many.

        Raises
        ------
        TooOften
        """
        with self._lock:
            at = self._clock()
            keys = self._keys(name, address)
            left = max(self._left(key, free, at) for key, free in keys)
            if left > 0:
                raise TooOften(ceil(left))
            for key, _ in keys:
                count, last = self._failed.pop(key, (0, at))
                self._failed[key] = (1 if at - last > LONGEST else count + 1, at)
            while len(self._failed) > _KEPT:
                self._failed.popitem(last=False)

    def succeeded(self, name: str, address: str) -> None:
        """The password was right: the name begins anew, the address has one failure less, and is one of the name."""
        with self._lock:
            (by_name, _), (by_address, _) = self._keys(name, address)
            self._failed.pop(by_name, None)
            self._homes[_folded(name), address] = None
            while len(self._homes) > _KEPT:
                self._homes.popitem(last=False)
            count, last = self._failed.get(by_address, (1, 0.0))
            self._failed[by_address] = (count - 1, last)

    def _left(self, key: tuple[str, str], free: int, at: float) -> float:
        count, last = self._failed.get(key, (0, at))
        if count < free or at - last > LONGEST:
            return 0.0
        return last + min(2.0 ** min(count - free, 20), LONGEST) - at

    def _keys(self, name: str, address: str) -> tuple[tuple[tuple[str, str], int], tuple[tuple[str, str], int]]:
        """Where failures are counted. Those of strangers are not those of who has logged in from this address before."""
        of = _folded(name)
        by_name = ("name at home", f"{of}\0{address}") if (of, address) in self._homes else ("name", of)
        return (by_name, FREE_BY_NAME), (("address", address), FREE_BY_ADDRESS)


def _folded(name: str) -> str:
    return name.strip().casefold()
