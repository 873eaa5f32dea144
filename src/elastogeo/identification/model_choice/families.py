"""The richer models that are tried: every column by itself, what belongs together, and mixtures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np

from elastogeo.identification.model_choice.candidates import COMPLIANCE, FORCE, GEOMETRY
from elastogeo.identification.model_choice.comparison import CONTACT, SEARCHED, SECOND, Comparison
from elastogeo.identification.model_choice.evidence import Evidence, cauchy

PROMISING = 0.1
"""P-value at most of the columns of a model that is tried by itself."""


@dataclass(frozen=True, slots=True)
class Family:
    """Columns that make a model together."""

    name: str
    added: tuple[str, ...]
    exponent: float | None = None

    @property
    def parameters(self) -> int:
        """How many, an exponent included."""
        return len(self.added) + (self.exponent is not None)

    @property
    def held(self) -> frozenset[str]:
        """The columns, whatever the exponent."""
        return held(self.added)

    def promising(self, first: Evidence) -> bool:
        """Whether its columns were missed when the model without them was tested."""
        p_values = np.array([first.p_values[first.labels.index(label)] for label in self.held if label in first.labels])
        return bool(len(p_values)) and cauchy(p_values, np.ones(len(p_values))) < PROMISING


def held(added: Iterable[str]) -> frozenset[str]:
    """Columns, whatever the exponent."""
    return frozenset(label.removesuffix(SEARCHED) for label in added)


def families(chosen: Comparison, first: Evidence) -> Iterator[Family]:
    """The models that are tried one by one."""
    yield from (Family(label, (label,)) for label in first.labels if not label.endswith(SECOND))
    for label in first.labels:
        if label.endswith(SECOND) and chosen.places[label] in (FORCE, COMPLIANCE):
            yield Family(label, (label.removesuffix(SECOND), label))
    gains = [label for label in first.labels if label.startswith("CF1_")]
    on_axis = [label for label in gains if label[4] == label[5] == label[6]]
    contact = [label for label in first.labels if label.startswith("H_")]
    geometry = [label for label in first.labels if chosen.places[label] == GEOMETRY]
    for name, labels in (("linear on the axes", on_axis), ("linear", gains), ("contact", contact), ("geometry", geometry)):
        if len(labels) > 1:
            yield Family(name, tuple(labels))
    if chosen.exponent is not None:
        yield Family(CONTACT + SEARCHED, (CONTACT + SEARCHED,), chosen.exponent)
        if len(contact) > 1:
            yield Family("contact" + SEARCHED, tuple(label + SEARCHED for label in contact), chosen.exponent)


def mixtures(some: Iterable[Family], every: Iterable[Family]) -> list[Family]:
    """Each of some models together with each of all."""
    pairs = {tuple(sorted((one, other), key=_name)) for one, other in product(some, every) if not one.held & other.held}
    return sorted((_mixture(one, other) for one, other in pairs), key=_name)


def _mixture(one: Family, other: Family) -> Family:
    exponent = one.exponent if other.exponent is None else other.exponent
    return Family(f"{one.name} and {other.name}", (*one.added, *other.added), exponent)


def _name(family: Family) -> str:
    return family.name
