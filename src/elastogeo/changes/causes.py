"""Which component a changed set of indicators points to, and what this test cannot tell from it.

Each component has a few ways to fail, each a row of the signatures: what such a fault does to every indicator. A component
explains a change as far as some of its rows, none of them with a sign that no fault has, add up to it within the scatter.
How well it does so is its marginal likelihood, the sizes of its faults being unknown: one that takes several ways to fail
pays for each. Only directions count: how large a fault is usual, nobody knows.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.machine import Array
from elastogeo.result import Part

LEAST_SHARE = 0.5
"""Of the changes that a component must explain to be named."""

LEAST_SCORE = 0.05
"""Likelihood, of all components, below which one is not named."""

CANNOT_TELL = 0.1
"""Share of the best likelihood from which a component cannot be told from the best."""

INEXACT = 0.1
"""Share by which a signature may be off: it is of first order, of the machine as it was when it was made."""

PARALLEL = 0.999
"""Cosine from which two ways to fail of one component are one."""

MOST_WAYS = 3
"""Ways to fail of one component that are looked at together."""


@dataclass(frozen=True, slots=True, eq=False)
class Signatures(ByValue):
    """How each component's fault moves the indicators of a recipe: plain numbers, kept with the series.

    Attributes
    ----------
    components : tuple of str, length c
        `guideway X`, `drive Y`, `squareness XY`, `spindle side`, `instrument`. One that may fail in several ways has a row
        for each.
    indicators : tuple of str, length q
    matrix : array, shape (c, q)
        Change of each indicator, in its unit, for a fault of the component of a typical size; zero where it moves nothing,
        NaN where it is not known.
    one_sided : tuple of bool, length c
        Whether a fault has this sign only: nothing gets stiffer by wear.
    """

    components: tuple[str, ...]
    indicators: tuple[str, ...]
    matrix: Array
    one_sided: tuple[bool, ...]

    @property
    def unseen(self) -> tuple[str, ...]:
        """Components whose faults move no indicator of this test."""
        moves = dict.fromkeys(self.components, False)
        for name, row in zip(self.components, self.matrix, strict=True):
            moves[name] |= bool(np.any(np.nan_to_num(row)))
        return tuple(name for name, moved in moves.items() if not moved)

    def of(self, indicators: Sequence[str]) -> Array:
        """The matrix for other indicators, shape (c, len(indicators)); NaN for those that it does not have."""
        found = np.full((len(self.components), len(indicators)), np.nan)
        for k, name in enumerate(indicators):
            if name in self.indicators:
                found[:, k] = self.matrix[:, self.indicators.index(name)]
        return found

    def document(self) -> dict[str, Any]:
        """As plain values, to be kept as JSON; what is not known is None."""
        rows = [[None if np.isnan(value) else float(value) for value in row] for row in self.matrix]
        return {
            "components": list(self.components),
            "indicators": list(self.indicators),
            "matrix": rows,
            "one_sided": list(self.one_sided),
        }

    @staticmethod
    def of_document(document: dict[str, Any]) -> Signatures:
        """What `document` gave."""
        components, indicators = tuple(document["components"]), tuple(document["indicators"])
        matrix = np.array(document["matrix"], dtype=float).reshape(len(components), len(indicators))
        return Signatures(components, indicators, matrix, tuple(map(bool, document["one_sided"])))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Cause(Part):
    """A component whose fault would change the indicators as they changed.

    Attributes
    ----------
    component : str
    share : float
        Of the changes, weighted by their scatter, that it explains, 0 to 1.
    score : float
        Its likelihood, relative to all components, 0 to 1.
    supported_by : tuple of str
        Indicators in alarm that it moves to the side on which they moved.
    against : tuple of str
        Indicators that it should have moved and that did not, or that moved although it does not move them.
    alike : tuple of str
        Components whose faults move the indicators of this test in the same way.
    """

    component: str
    share: float
    score: float
    supported_by: tuple[str, ...]
    against: tuple[str, ...] = field(default=())
    alike: tuple[str, ...] = field(default=())


@dataclass(frozen=True, slots=True, eq=False)
class _Explained:
    """How a component explains a change: its likelihood (a logarithm), what it leaves and what it makes, shape (q,)."""

    component: str
    likelihood: float
    made: Array


def causes_of(
    change: Array, deviation: Array, signatures: Signatures, indicators: Sequence[str], changed: Sequence[str]
) -> tuple[tuple[Cause, ...], tuple[tuple[str, ...], ...]]:
    """Which components explain a change, the likeliest first, and those among which the test cannot tell.

    Parameters
    ----------
    change, deviation : array, shape (q,)
        Of each indicator since the change, less its baseline, and the standard deviation of that difference; NaN where it
        is not known.
    signatures : Signatures
    indicators : sequence of str, length q
    changed : sequence of str
        Those in alarm.
    """
    matrix = signatures.of(indicators)
    known = np.isfinite(change) & np.isfinite(deviation) & (deviation > 0) & np.isfinite(matrix).all(axis=0)
    if not known.any():
        return (), ()
    y, rows = change[known] / deviation[known], matrix[:, known] / deviation[known]
    names = [name for name, one in zip(indicators, known, strict=True) if one]
    explained = sorted(_explanations(y, rows, signatures), key=lambda one: -one.likelihood)
    if not explained:
        return (), ()
    best = explained[0].likelihood
    total = sum(np.exp(one.likelihood - best) for one in explained)
    found = []
    alike = tuple(one.component for one in explained if np.exp(one.likelihood - best) >= CANNOT_TELL)
    for one in explained:
        score, share = float(np.exp(one.likelihood - best) / total), _share(y, one.made)
        if share >= LEAST_SHARE and (score >= LEAST_SCORE or one.component in alike):
            others = tuple(name for name in alike if name != one.component) if one.component in alike else ()
            found.append(Cause(one.component, share, score, *_evidence(y, one.made, names, changed), others))
    named = tuple(one.component for one in found if one.alike)
    return tuple(found), ((named,) if len(named) > 1 else ())


def _share(y: Array, made: Array) -> float:
    return max(0.0, 1.0 - float(np.sum((y - made) ** 2) / np.sum(y**2))) if y.any() else 0.0


def _evidence(
    y: Array, made: Array, names: Sequence[str], changed: Sequence[str]
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Changed indicators that a component moves as they moved, and what speaks against it: two standard deviations count."""
    pairs = list(zip(names, y, made, strict=True))
    wide = 2 + INEXACT * float(np.abs(y).max())
    supports = tuple(name for name, seen, by in pairs if name in changed and seen * by > 0 and abs(by) > 1)
    against = tuple(name for name, seen, by in pairs if abs(seen - by) > wide and name not in supports)
    return supports, against


def _explanations(y: Array, rows: Array, signatures: Signatures) -> Iterator[_Explained]:
    """Each component that moves any indicator, by the best of the ways in which it may have failed."""
    own = 1 + (INEXACT * y) ** 2 + (INEXACT / 3) ** 2 * float(y @ y)
    for component in dict.fromkeys(signatures.components):
        at = [k for k, name in enumerate(signatures.components) if name == component]
        ways = _distinct([(rows[k] / np.linalg.norm(rows[k]), signatures.one_sided[k]) for k in at if rows[k].any()])
        best = max(_combined(y, own, ways), key=lambda one: one[0], default=None)
        if best is not None:
            yield _Explained(component, round(best[0], 6), best[1])


def _distinct(ways: Sequence[tuple[Array, bool]]) -> list[tuple[Array, bool]]:
    """Ways to fail, of which none is another once more; one that goes both ways stands for one that does not."""
    found: list[tuple[Array, bool]] = []
    for direction, one_sided in sorted(ways, key=lambda way: way[1]):
        known = ((float(direction @ other), sided) for other, sided in found)
        if not any(cosine > PARALLEL or (cosine < -PARALLEL and not sided) for cosine, sided in known):
            found.append((direction, one_sided))
    return found


def _combined(y: Array, own: Array, ways: Sequence[tuple[Array, bool]]) -> Iterator[tuple[float, Array]]:
    """Log-likelihood of each set of ways to fail, their sizes being of the order of the change, and what it makes of it."""
    size = float(y @ y)
    for number in range(1, min(len(ways), MOST_WAYS) + 1):
        for chosen in combinations(ways, number):
            M = np.array([direction for direction, _ in chosen]).T
            spread = np.diag(own) + size * M @ M.T
            weights = np.linalg.solve(spread, y)
            amounts = size * M.T @ weights
            if any(one_sided and amount <= 0 for (_, one_sided), amount in zip(chosen, amounts, strict=True)):
                continue
            likelihood = -0.5 * (float(y @ weights) + float(np.linalg.slogdet(spread)[1]))
            yield likelihood - (number - 1) * float(np.log(len(ways))), M @ amounts
