"""How often a password may be tried: ever more slowly, by name and by address.

It is kept in memory, of the last thousands of names: a restart forgets it, and whoever guesses finds the next password as
slow to compare as the one before.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from math import ceil
from threading import BoundedSemaphore, Lock
from time import monotonic

from elastogeo.errors import InputError

FREE_BY_NAME, FREE_BY_ADDRESS = 5, 20
"""Failures in a row that cost nothing. A shop may share one address."""
LONGEST = 900.0
"""Seconds that one waits at most, and after which it is as if nothing had been."""
_KEPT = 10_000
_AT_ONCE = 2


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
        self.comparing = BoundedSemaphore(_AT_ONCE)  # each takes 64 MiB

    def check(self, name: str, address: str) -> None:
        """Refuse who must wait; else it counts as a failure until `succeeded`, so that many at once are none too many.

        Raises
        ------
        TooOften
        """
        with self._lock:
            at = self._clock()
            left = max(self._left(key, free, at) for key, free in _keys(name, address))
            if left > 0:
                raise TooOften(ceil(left))
            for key, _ in _keys(name, address):
                count, last = self._failed.pop(key, (0, at))
                self._failed[key] = (1 if at - last > LONGEST else count + 1, at)
            while len(self._failed) > _KEPT:
                self._failed.popitem(last=False)

    def succeeded(self, name: str, address: str) -> None:
        """The password was right: the name begins anew, the address has one failure less."""
        by_name, by_address = (key for key, _ in _keys(name, address))
        with self._lock:
            self._failed.pop(by_name, None)
            count, last = self._failed.get(by_address, (1, 0.0))
            self._failed[by_address] = (count - 1, last)

    def _left(self, key: tuple[str, str], free: int, at: float) -> float:
        count, last = self._failed.get(key, (0, at))
        if count < free or at - last > LONGEST:
            return 0.0
        return last + min(2.0 ** min(count - free, 20), LONGEST) - at


def _keys(name: str, address: str) -> tuple[tuple[tuple[str, str], int], ...]:
    return ((("name", name.strip().casefold()), FREE_BY_NAME), (("address", address), FREE_BY_ADDRESS))
