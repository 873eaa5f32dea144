"""What a comparison of models works on: the shapes of all runs, with every column that is offered, each once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.estimate import merge, solve
from elastogeo.identification.influences import Effect
from elastogeo.identification.model_choice.candidates import (
    COMPLIANCE,
    EXPONENTS,
    HERTZ,
    NODES,
    OFFSET,
    offered,
)
from elastogeo.identification.model_choice.evidence import SEEN, Evidence, evidence, weights_by_order
from elastogeo.identification.model_choice.following import OffLevel, off_level
from elastogeo.identification.model_choice.shapes import Shapes, shapes_of
from elastogeo.identification.run_system import RunSystem
from elastogeo.identification.systems import Systems
from elastogeo.machine import Array, Machine

CONTACT = "every contact alike"

BEND = "force bend"

SECOND = ", second order"

SEARCHED = "*"
"""Ends the label of a contact column whose exponent was searched."""

OFFSET_SEEN = 0.2
"""As `SEEN`, of an offset of the force: where less is seen of it, an offset as large as the force would be needed."""

COINCIDE = 1e-6
"""One minus the cosine of the angle between what two columns are beyond the model, below which they are one."""

WORTH_HAVING = 0.01
"""Share of what the model leaves that a column must remove from the traces: less is not worth a parameter."""

ROUNDING = 1e-5
"""Share of the readings below which nothing counts: the linear model leaves as much."""

_FINENESS = 66
_RENEWALS = 3


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """What the steps of a comparison share.

    Attributes
    ----------
    shapes : Shapes
    model : tuple of str
        Labels of the model as asked.
    owners : mapping of str to tuple of str
        The columns that it could have besides, each with all that coincide with it.
    unseen : tuple of str
        The columns that the model holds: no test of this kind can see them.
    places : mapping of str to str
        Of every column that was offered.
    levels : tuple of (float [N], tuple of int)
        Each level with its runs.
    contact : array, shape (nodes, n, k)
        Columns of a contact law, for each of `NODES`; the last is that of all together.
    elastic : tuple of str
        Compliances of the model.
    set_again : array, shape (runs,)
        Relative standard uncertainty with which the force of each run is set.
    influences : tuple of str
        Labels of the columns that hold what one standard uncertainty of each influence moves.
    exponent : float or None
        Of the contact columns that were searched.
    """

    shapes: Shapes
    model: tuple[str, ...]
    owners: Mapping[str, tuple[str, ...]]
    unseen: tuple[str, ...]
    places: Mapping[str, str]
    levels: tuple[tuple[float, tuple[int, ...]], ...]
    contact: Array
    elastic: tuple[str, ...]
    set_again: Array
    influences: tuple[str, ...] = ()
    exponent: float | None = None

    @property
    def least(self) -> float:
        """Length [mm or rad] that a column must remove from the traces."""
        base, reading = self.shapes.of(self.model), self.shapes.reading
        left = reading - base @ np.linalg.lstsq(base, reading, rcond=None)[0]
        total = float(np.sqrt(np.sum(reading**2) + np.sum(self.shapes.rest)))
        return max(WORTH_HAVING * float(np.linalg.norm(left)), ROUNDING * total)

    @property
    def shares(self) -> dict[str, float]:
        """The weight of each column: every place counts the same, however many columns it has; contact is one more."""
        kinds = {label: CONTACT if label in contacts(self.owners) else self.places[label] for label in self.owners}
        counts = Counter(kinds.values())
        return {label: 1.0 / counts[kind] for label, kind in kinds.items()}

    def evidence(self, added: Sequence[str] = (), without: Sequence[int] = ()) -> Evidence:
        """What a model with these columns besides lacks, as all runs say or all but some."""
        shapes = self.shapes.without(without) if without else self.shapes
        return evidence(shapes, [*self.model, *added], self.shares, self.least)

    def off_level(self, added: Sequence[str] = ()) -> OffLevel | None:
        """The level that does not follow the others by a model with these columns besides, if one does not."""
        shapes, model = self.shapes, [*self.model, *added]
        values = np.linalg.pinv(shapes.of(model)) @ shapes.reading
        by_force = shapes.of(self.elastic) @ values[[model.index(label) for label in self.elastic]]
        force = np.zeros((len(shapes.reading), len(shapes.rest)))
        force[np.arange(len(force)), shapes.run] = by_force * self.set_again[shapes.run]
        known = shapes.of(self.influences) * shapes.lengths_of(self.influences)
        return off_level(shapes, model, self.levels, force, known)

    def renewed(self) -> Comparison:
        """The same with columns of a force that bends that count from the compliances at no force, not from their mean.

        Where they change much, the model as asked takes for a compliance what it is in the middle of the forces, and each
        for another middle, as geometry is beside it or not.
        """
        shapes = self.shapes
        if BEND not in self.owners:
            return self
        for _ in range(_RENEWALS):
            labels = [*self.model, BEND]
            weights = weights_by_order(shapes, labels)
            values = np.linalg.lstsq(shapes.of(labels) * weights[:, np.newaxis], shapes.reading * weights, rcond=None)[0]
            values = values / shapes.lengths_of(labels)
            amounts = np.array([values[labels.index(label)] for label in self.elastic])
            for name, power in ((BEND, "linear"), (BEND + SECOND, "quadratic")):
                gains = [f"{label} {power}" for label in self.elastic]
                shapes = shapes.with_columns([name], (shapes.of(gains) * shapes.lengths_of(gains) @ amounts)[:, np.newaxis])
        return replace(self, shapes=shapes)

    def searched(self) -> Comparison:
        """The same with contact columns at the exponent that leaves least, orders weighed by their scatter."""
        names = contacts(self.owners)
        if not names:
            return self
        weights = weights_by_order(self.shapes, self.model)
        Q = np.linalg.qr(self.shapes.of(self.model) * weights[:, np.newaxis])[0]
        left = self.shapes.reading * weights
        left = left - Q @ (Q.T @ left)
        exponents = np.linspace(*EXPONENTS, _FINENESS)
        columns = np.column_stack([_between(self.contact[:, :, -1:], a)[:, 0] for a in exponents]) * weights[:, np.newaxis]
        columns -= Q @ (Q.T @ columns)
        exponent = float(exponents[int(np.argmax((left @ columns) ** 2 / np.sum(columns**2, axis=0)))])
        every = [label for label in self.shapes.labels if label == CONTACT or label.startswith("H_")]
        shapes = self.shapes.with_columns([name + SEARCHED for name in every], _between(self.contact, exponent))
        return replace(self, shapes=shapes, exponent=exponent)


def prepared(
    machine: Machine, systems: Systems, retained: Sequence[str], angular: bool, effects: Sequence[Effect] = ()
) -> Comparison:
    """The shapes of a test with every column that is offered.

    Parameters
    ----------
    machine : Machine
    systems : Systems
        No reference subtracted.
    retained : sequence of str
        Parameters of the model as asked.
    angular : bool
        Whether the readings count along an angle.
    effects : sequence of Effect
        Of what is known to be uncertain.
    """
    values = solve(merge(*(run.factor for run in systems.runs)), retained).values
    columns = offered(machine, systems, retained, values, angular)
    labels = _numbered([offer.name for offer in columns.offers])
    nodes = [f"{label} {k}" for k in range(len(NODES)) for label in columns.contact]
    gains = [f"{label} {power}" for power in ("linear", "quadratic") for label in columns.elastic]
    known = [_influenced(systems, k, retained, values, effects) for k in range(len(systems.runs))]
    influences = tuple(f"influence {k}" for k in range(len(effects)))
    blocks = [np.column_stack(of) for of in zip(columns.blocks, columns.contacts, columns.gains, known, strict=True)]
    ceilings = np.concatenate([columns.ceilings, np.zeros(len(effects))])
    shapes = shapes_of(systems, retained, [*labels, *nodes, *gains, *influences], blocks, ceilings, angular)
    names = [*(f"H_{label[2:]}" for label in columns.contact), CONTACT] if columns.contact else []
    amounts = np.array([values[list(retained).index(label)] for label in columns.contact])
    each = (shapes.of(nodes) * shapes.lengths_of(nodes)).reshape(len(shapes.reading), len(NODES), len(columns.contact))
    contact = np.concatenate([each, each @ amounts[:, np.newaxis]], axis=2).swapaxes(0, 1)
    shapes = shapes.with_columns(names, _between(contact, HERTZ)) if names else shapes
    places = {label: offer.place for label, offer in zip(labels, columns.offers, strict=True)}
    places |= dict.fromkeys(names, COMPLIANCE)
    levels = tuple((level, _at(systems, level)) for level in systems.levels)
    owners, unseen = _owners(shapes, retained, list(places))
    set_again = np.array([_set_again(systems, run) for run in systems.runs])
    return Comparison(
        shapes, tuple(retained), owners, unseen, places, levels, contact, columns.elastic, set_again, influences
    )


def _influenced(systems: Systems, which: int, retained: Sequence[str], values: Array, effects: Sequence[Effect]) -> Array:
    """By how much the readings of a run are off its model for one standard uncertainty of each effect, shape (m, e)."""
    run, labels = systems.runs[which], [source.name for source in systems.sources]
    degrees = {source.name: source.force_degree for source in systems.sources}
    by_force = run.design_of(retained) @ (values * [degrees[label] for label in retained])
    moved = np.zeros((len(run.reading), len(effects)))
    for k, effect in enumerate(effects):
        moved[:, k] -= effect.stretch[which] * by_force
        if effect.shift is not None:
            moved[:, k] += effect.shift(run)
        if effect.columns is not None:
            moved[:, k] -= effect.columns(run)[:, [labels.index(label) for label in retained]] @ values
    return moved * [effect.influence.standard_uncertainty for effect in effects]


def _set_again(systems: Systems, run: RunSystem) -> float:
    return systems.applied.spread.of(run.force) / abs(run.force) if run.force else 0.0


def contacts(labels: Iterable[str]) -> list[str]:
    """Those that are a contact law's."""
    return [label for label in labels if label == CONTACT or label.startswith("H_")]


def _between(contact: Array, exponent: float) -> Array:
    """Contact columns at an exponent between the nodes (Lagrange)."""
    others = [np.delete(NODES, k) for k in range(len(NODES))]
    shares = [np.prod((exponent - other) / (node - other)) for node, other in zip(NODES, others, strict=True)]
    return np.asarray(np.tensordot(shares, contact, axes=1))


def _at(systems: Systems, level: float) -> tuple[int, ...]:
    there = systems.at(level)
    return tuple(k for k, run in enumerate(systems.runs) if any(run is other for other in there))


def _numbered(names: Sequence[str]) -> list[str]:
    """The names, the second of two that are alike (cosine and sine of a form) with a mark."""
    return [name if name not in names[:k] else f"{name} (sine)" for k, name in enumerate(names)]


def _owners(
    shapes: Shapes, model: Sequence[str], labels: Sequence[str]
) -> tuple[dict[str, tuple[str, ...]], tuple[str, ...]]:
    """The columns that are neither in the model nor free of it, each with those that coincide with it; and those in it.

    What it holds, no test of this kind can see; what it is free of moves none of its parameters.
    """
    base, added = np.linalg.qr(shapes.of(model))[0], shapes.of(labels)
    inside = base @ (base.T @ added)
    beyond = added - inside
    size, touched = np.linalg.norm(beyond, axis=0), np.linalg.norm(inside, axis=0)
    unit = beyond / np.where(size > 0, size, 1.0)
    owners: dict[str, tuple[str, ...]] = {}
    unseen = []
    for k, label in enumerate(labels):
        if touched[k] <= SEEN:
            continue
        if size[k] <= (OFFSET_SEEN if label == OFFSET else SEEN):
            unseen.append(label)
            continue
        like = next((x for x in owners if 1 - abs(unit[:, labels.index(x)] @ unit[:, k]) < COINCIDE), None)
        owners |= {label: (label,)} if like is None else {like: (*owners[like], label)}
    return owners, tuple(unseen)
