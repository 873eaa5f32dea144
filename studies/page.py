"""The page of the rates, `docs/verdicts.md`, from the studies and what was counted."""

from __future__ import annotations

from collections.abc import Mapping

from studies.bar_tests import SET_ANEW
from studies.noise import NOISES
from studies.rates import Cell, Rate, Study

HEAD = """# How far a verdict can be trusted

Every check of a verdict is an instrument, so it has two rates: how often it alarms where nothing is wrong, and how often it
finds its fault at a stated size. They are counted here on simulated tests whose truth the program does not know; the
simulator (`studies/`) shares no physics with it. `make studies` counts again, from the same seeds, and writes this page.

A rate is given in percent with its 95 % interval (Wilson). **Bold: the interval does not reach what is wanted.** Where a
check says "not tested" it says neither yes nor no; such draws are counted apart.

Layouts: *7 runs* at 36, 112, 238, 364, 490, 616 and 742 N; *15 runs*, the same levels with 364 and 490 N five times each;
*8 runs*, at 36, 238, 490 and 742 N twice, as `elastogeo new` has it; *two runs*, 36 and 742 N; *one run*, 364 N; *three
pairs*, counter-clockwise and clockwise, of an unloaded bar. A run is one turn of 72 readings on a radius of 150 mm, on a
machine `wFYXt` with the values of Tables 5.5 and 5.6 of the thesis.

Noises: *white* of 0.1 um, which is in all others too; *autocorrelated*, AR(1) with 0.9 from reading to reading, 0.3 um;
*of the run*, an offset and harmonics of order 2 and 3 drawn once a run, 0.5 um each coefficient; *harmonic*, orders 1 to 5
whose amplitude (0.5 um) and phase are drawn once a run; *quantised* to steps of 0.5 um; *eccentricity*, a centre that
wanders by 1 um from run to run; *force set anew*, a force that each run sets again to 0.2 %, of a gauge that is off by 1 %.
"""

PARTS = {
    0: "## Ball bar: the verdict of an identification",
    1: "## Models, physics, intervals",
    2: "## Other tests",
    3: "## Test after test: the charts of a series",
}


def page(known: Mapping[str, Study], found: Mapping[str, Mapping[Cell, Rate]]) -> str:
    """The whole page, Markdown."""
    parts = [HEAD]
    for order, heading in PARTS.items():
        chosen = [name for name, study in known.items() if study.order == order and found[name]]
        if chosen:
            parts.append(f"{heading}\n")
            parts.extend(section(known[name], found[name]) for name in chosen)
    return "\n".join(parts)


def section(study: Study, found: Mapping[Cell, Rate]) -> str:
    """One check: its words, and a table of rates; a column a noise."""
    noises = list(dict.fromkeys(cell.noise for cell in found))
    known = [*NOISES, SET_ANEW]
    noises.sort(key=lambda name: known.index(name) if name in known else len(known))
    rows: dict[tuple[str, str, str, int], dict[str, str]] = {}
    for cell, rate in found.items():
        rows.setdefault((cell.truth, cell.layout, wanted(cell), rate.trials), {})[cell.noise] = shown(cell, rate)
    lines = [
        f"### {study.check}\n",
        f"{study.about}\n",
        f"| truth | layout | wanted | draws | {' | '.join(noises)} |",
        f"| --- | --- | --- | ---: |{' --- |' * len(noises)}",
    ]
    for (truth, layout, aim, trials), by_noise in rows.items():
        given = " | ".join(by_noise.get(noise, "") for noise in noises)
        lines.append(f"| {truth} | {layout} | {aim} | {trials} | {given} |")
    return "\n".join(lines) + "\n"


def wanted(cell: Cell) -> str:
    """What the rate is to be, in words."""
    word = " or ".join(cell.counted)
    if not cell.least and cell.most == 1.0:
        return f"{word}, as it comes"
    return f"{word} ≥ {100 * cell.least:g} %" if cell.least else f"{word} ≤ {100 * cell.most:g} %"


def shown(cell: Cell, rate: Rate) -> str:
    """A rate, its interval, and what else was said."""
    low, high = rate.interval
    text = f"{100 * rate.share:.3g} ({100 * low:.2g} to {100 * high:.3g})"
    if not rate.meets(cell):
        text = f"**{text}**"
    others = [(word, n) for word, n in rate.words if word not in (*cell.counted, "silent", "alarm")]
    return "; ".join([text, *(f"{100 * n / rate.trials:.3g} {word}" for word, n in others)])
