"""Simulated histories watched by the charts of elastogeo, many machines at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.changes import Prior, Rule, reference_from, start, step
from studies.histories import Histories, Ways, histories

NEVER = 10**6


@dataclass(frozen=True)
class Watched:
    """What a history of one machine led to.

    Attributes
    ----------
    alarm : int
        Tests from the beginning of the fault to the first alarm, which is 1 if it is the first of these; 0 or less for an
        alarm before it, `NEVER` without one.
    first : int
        The indicator that is named first.
    repeats : int
        That were asked for until then.
    """

    alarm: int
    first: int
    repeats: int


def watched(
    ways: Ways,
    machines: int,
    seed: tuple[int, ...],
    rule: Rule | None = None,
    prior: tuple[float, float] = (6.0, 1.0),
    covariate: bool = False,
    repeat: bool = True,
) -> list[Watched]:
    """Machines, each until its first alarm: a suspect test is repeated the same day; a repeat that confirms it is one."""
    rule = rule or Rule()
    seen: Histories = histories(ways, machines, seed)
    m, q = ways.baseline, ways.indicators
    warm = seen.temperature if covariate else np.full_like(seen.temperature, np.nan)
    expected = Prior(np.full(q, prior[0]), np.full(q, prior[1]))
    reference = reference_from(seen.value[:, :m], expected, temperature=warm[:, :m])
    charts = start(reference)
    alarm, first, repeats = np.full(machines, NEVER), np.zeros(machines, dtype=int), np.zeros(machines, dtype=int)
    for t in range(m, m + ways.tests):
        charts, judged = step(charts, reference, rule, seen.value[:, t], warm[:, t])
        signal = np.any(judged.over != 0, axis=1)
        ratio = judged.ratio
        if repeat and signal.any():
            repeats += signal & (alarm == NEVER)
            again = np.where(signal[:, np.newaxis], seen.repeated[:, t], np.nan)
            charts, judged = step(charts, reference, rule, again, warm[:, t], answers=signal)
            signal = np.any(judged.confirmed, axis=1)
            ratio = np.where(judged.confirmed, judged.ratio, 0.0)
        new = signal & (alarm == NEVER)
        alarm[new] = t - m - ways.fault.after + 1
        first[new] = np.argmax(ratio[new], axis=1)
    return [Watched(*map(int, row)) for row in zip(alarm, first, repeats, strict=True)]
