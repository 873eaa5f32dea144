"""What the instruments at hand cannot tell, and the tests that the program proposes for it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from elastogeo.machine import Array
from elastogeo.observe import PROBES
from elastogeo.planning.ceilings import ceiling
from elastogeo.planning.families import family_ceiling
from elastogeo.planning.information import Unknowns
from elastogeo.planning.offers.across import across
from elastogeo.planning.offers.candidate import Candidate
from elastogeo.planning.offers.candidates import candidates
from elastogeo.planning.offers.means import Means
from elastogeo.planning.reasons import Reason, reason_for
from elastogeo.prediction import SUPPORTED, unsupported_share

OTHER_TESTS = 60
"""Tests of another instrument that are drawn where the ones at hand do not tell what is asked for."""


def out_of_reach(asked: Unknowns, names: Sequence[str], seen: Array) -> tuple[str, ...]:
    """The named parameters that are not known by themselves in a row space, shape (p, r)."""
    at = [asked.names.index(name) for name in names]
    share = unsupported_share(np.eye(len(asked.names))[at], seen, np.ones(len(asked.names)))
    return tuple(name for name, missed in zip(names, share, strict=True) if missed >= SUPPORTED)


def reasons_for(asked: Unknowns, names: Sequence[str], reciprocal: bool) -> tuple[Reason, ...]:
    """Why some of the named parameters are known by no test between tool and workpiece."""
    found = ceiling(asked.machine, reciprocal)
    return tuple(why for name in names if (why := reason_for(asked.machine, found, name)) is not None)


def proposed_for(
    means: Means, asked: Unknowns, names: Sequence[str], reasons: Sequence[Reason], reciprocal: bool, seed: int
) -> tuple[Candidate, ...]:
    """Tests of other instruments, for parameters that those at hand do not tell.

    A probe across the joint where no test between tool and workpiece tells it; else forces and probes in several directions,
    and where these see too little, a frame of sensors that reads the whole twist.
    """
    random = np.random.default_rng([seed, 1])
    found = list(_across(means, reasons, random))
    others = [name for name in names if all(why.name != name for why in reasons)]
    if others:
        seen = family_ceiling(means.machine, PROBES, means.tool_points, reciprocal).seen
        instrument = "sensor-frame" if out_of_reach(asked, others, seen) else "displacement-probes"
        found += candidates(means, [instrument], OTHER_TESTS, seed)
    return tuple(found)


def _across(means: Means, reasons: Sequence[Reason], random: np.random.Generator) -> Iterator[Candidate]:
    probes = dict.fromkeys(probe for why in reasons if why.remedy for probe in why.remedy.probes)
    for k, probe in enumerate(probes, start=1):
        one = across(means, random, probe.across, probe.sensor, probe.point)
        yield Candidate(f"{one.name}_{k}", one.test, one.minutes)
