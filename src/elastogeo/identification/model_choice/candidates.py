"""What a model may lack: columns from the four places where a misfit can live.

Geometry: error motions and location errors that were not asked for, the form of a ball. Compliance: what each gains with the
force, a contact law. Force: an offset, a scale that bends. Set-up: its own compliance (Eq. 5.38), and how that bends.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase

import numpy as np

from elastogeo.identification.preference import moving_axes
from elastogeo.identification.systems import Systems
from elastogeo.machine import Array, Machine
from elastogeo.observe import Observations
from elastogeo.sources import Source, catalogue, column_ceilings, design_rows, select_sources

GEOMETRY, COMPLIANCE, FORCE, SET_UP = "geometry", "compliance", "force", "set-up"

OFFSET = "force offset"

BALL_ORDERS = range(2, 9)
"""Orders, per turn, of the form of a ball."""

EXPONENTS = (0.3, 0.95)
"""Of a contact law; at 1 it is a constant compliance."""

HERTZ = 2.0 / 3.0

NODES = EXPONENTS[0] + (EXPONENTS[1] - EXPONENTS[0]) * (0.5 - 0.5 * np.cos(np.pi * (np.arange(7) + 0.5) / 7))
"""Exponents at which the columns of a contact law are made (Chebyshev); between them they are interpolated."""

_GEOMETRY = ("E_[XYZ]{axis}[123]", "E_[XYZ]{axis}[cs][12]", "E_[ABC](0*){axis}")
_OFFSETS = ("E_[XYZ]t0", "E_R0")


@dataclass(frozen=True, slots=True)
class Offer:
    """A parameter that the model could have besides.

    Attributes
    ----------
    name : str
        Of an error source (`E_XX3`, `CF1_XXX`, `H_XXX`), or `force offset`, `force bend` and `every compliance alike` (gains
        with the force), both also `, second order`, `set-up compliance`, `set-up bend`, `ball form, order 4`,
        `every contact alike`.
    place : str
        `geometry`, `compliance`, `force` or `set-up`.
    """

    name: str
    place: str


@dataclass(frozen=True, slots=True)
class Columns:
    """Columns of the offers, run by run.

    Attributes
    ----------
    offers : tuple of Offer, length q
    blocks : tuple of array, shape (m, q)
        One per run; nothing of the run's own is projected out yet.
    contact : tuple of str
        On-axis compliances for which contact columns follow: for each of `NODES` one column per compliance, in `contacts`.
    contacts : tuple of array, shape (m, nodes * len(contact))
        One per run.
    elastic : tuple of str
        Compliances of the model.
    gains : tuple of array, shape (m, 2 len(elastic))
        One per run: what each gains with the force, then with its square.
    ceilings : array, shape (q + nodes * len(contact) + 2 len(elastic),)
        Length that each column would have if nothing cancelled.
    """

    offers: tuple[Offer, ...]
    blocks: tuple[Array, ...]
    contact: tuple[str, ...]
    contacts: tuple[Array, ...]
    elastic: tuple[str, ...]
    gains: tuple[Array, ...]
    ceilings: Array


def offered(machine: Machine, systems: Systems, retained: Sequence[str], values: Array, angular: bool) -> Columns:
    """The columns that a model could have besides its retained ones.

    Parameters
    ----------
    machine : Machine
    systems : Systems
        No reference subtracted.
    retained : sequence of str
    values : array, shape (len(retained),)
        Their estimates: a force that is off moves the readings by them.
    angular : bool
        Whether the readings count along an angle, so that a ball may have a form.
    """
    elastic = elastic_among(systems, retained)
    amounts = np.array([values[retained.index(label)] for label in elastic])
    geometry = _geometry(machine, systems, retained)
    contact = tuple(label for label in elastic if label[2] == label[3] == label[4]) or tuple(elastic)
    gains = [f"CF{power}_{label[2:]}" for power in (1, 2) for label in elastic]
    exponents = [f"H{exponent:.9f}_{label[2:]}" for exponent in NODES for label in contact]
    sources = select_sources(machine, [*geometry, *elastic, *gains, *exponents])
    blocks: list[Array] = []
    contacts: list[Array] = []
    gains_of: list[Array] = []
    offers: list[Offer] = []
    for run in systems.runs:
        rows = design_rows(sources, machine, run.observations)[:, :-1]
        first, g, e = len(geometry), len(elastic), len(gains)
        plain, gain = rows[:, first : first + g], rows[:, first + g : first + g + e]
        made = [(Offer(n, SET_UP if fits_any(n, _OFFSETS) else GEOMETRY), rows[:, k]) for k, n in enumerate(geometry)]
        made += _form(run.observations) if angular else []
        made += _force(run.observations, plain, gain, amounts) if elastic else []
        made += _set_up(run.observations) if elastic else []
        made += [(Offer(gains[k], COMPLIANCE), gain[:, k]) for k in range(g)]
        offers = [offer for offer, _ in made]
        blocks.append(np.column_stack([column for _, column in made]))
        contacts.append(rows[:, first + g + e :])
        gains_of.append(gain)
    ceilings = dict(zip((source.name for source in sources), _ceilings(sources, machine, systems), strict=True))
    limits = [ceilings.get(name, 0.0) for name in (*(offer.name for offer in offers), *exponents, *gains)]
    return Columns(tuple(offers), tuple(blocks), contact, tuple(contacts), tuple(elastic), tuple(gains_of), np.array(limits))


def _ceilings(sources: Sequence[Source], machine: Machine, systems: Systems) -> Array:
    """Over all runs; those of one force at one circle are alike, so the strongest stands for all."""
    strongest = max(systems.runs, key=lambda run: abs(run.force)).observations
    return column_ceilings(sources, machine, strongest)


def elastic_among(systems: Systems, retained: Sequence[str]) -> list[str]:
    """The retained compliances that are constant in the model."""
    constant = {source.name for source in systems.sources if source.elastic and source.force_degree == 1.0}
    return [label for label in retained if label in constant and re.fullmatch(r"C_...", label)]


def _geometry(machine: Machine, systems: Systems, retained: Sequence[str]) -> list[str]:
    """Error motions of the moving axes and location errors that are not in the model."""
    moving = sorted(moving_axes(machine, [run.spans for run in systems.runs]))
    patterns = [pattern.format(axis=axis) for axis in moving for pattern in _GEOMETRY]
    return [name for name in catalogue(machine) if name not in retained and fits_any(name, (*patterns, *_OFFSETS))]


def _form(run: Observations) -> list[tuple[Offer, Array]]:
    return [
        (Offer(f"ball form, order {order}", GEOMETRY), wave(order * run.pose))
        for order in BALL_ORDERS
        for wave in (np.cos, np.sin)
    ]


def _force(run: Observations, plain: Array, gain: Array, amounts: Array) -> list[tuple[Offer, Array]]:
    """What the readings change by if the force is off, every compliance being what it was estimated as."""
    force = np.linalg.norm(run.wrench[:, :3], axis=1)
    per_force = np.divide(plain @ amounts, force, out=np.zeros_like(force), where=force > 0)
    linear, quadratic = np.split(gain, 2, axis=1)
    return [
        (Offer(OFFSET, FORCE), per_force),
        (Offer("force bend", FORCE), linear @ amounts),
        (Offer("every compliance alike", COMPLIANCE), linear @ amounts),
        (Offer("force bend, second order", FORCE), quadratic @ amounts),
        (Offer("every compliance alike, second order", COMPLIANCE), quadratic @ amounts),
    ]


def _set_up(run: Observations) -> list[tuple[Offer, Array]]:
    force = np.linalg.norm(run.wrench[:, :3], axis=1)
    return [(Offer("set-up compliance", SET_UP), force), (Offer("set-up bend", SET_UP), force**2)]


def fits_any(name: str, patterns: Sequence[str]) -> bool:
    """Whether a name fits one of several shell patterns."""
    return any(fnmatchcase(name, pattern) for pattern in patterns)
