"""Run the studies and write `docs/verdicts.md`: `make studies`, or `python -m studies.run --help`.

Counts are kept in `studies/counts`, a file a study, so that one check can be studied again without the others.
"""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path

from studies.checks import studies
from studies.page import page, shown, wanted
from studies.rates import Cell, Rate, Study, draws, rates

ROOT = Path(__file__).resolve().parents[1]
KEPT = ROOT / "studies" / "counts"
PAGE = ROOT / "docs" / "verdicts.md"
Counts = dict[str, dict[str, int]]
"""Of one study: by cell and word."""


def main(arguments: list[str] | None = None) -> int:
    """Run the chosen studies, keep their counts, write the page and say which rates are not what they should be."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("studies", nargs="*", metavar="STUDY", help="files of studies/checks, by name; all if none is named")
    parser.add_argument("--trials", type=int, default=400, help="draws where nothing is wrong (400)")
    parser.add_argument("--faults", type=int, default=100, help="draws with a fault (100)")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1, help="processes (one a core)")
    parser.add_argument("--noise", default="", help="one of the noises alone; the counts of the others stay")
    parser.add_argument("--page", action="store_true", help="run nothing, write the page from what is kept")
    given = parser.parse_args(arguments)
    known = studies()
    if unknown := set(given.studies) - known.keys():
        parser.error(f"there is no study {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    if not given.page:
        run({name: known[name] for name in given.studies or known}, given.trials, given.faults, given.workers, given.noise)
    found = {name: rates_of(study, read_counts(name)) for name, study in known.items()}
    PAGE.write_text(page(known, found), encoding="utf-8")
    for name, study in known.items():
        for cell, rate in found[name].items():
            if not rate.meets(cell):
                print(f"{study.check}: {cell.key}: {shown(cell, rate)}, wanted {wanted(cell)}")
    return 0


def run(chosen: dict[str, Study], trials: int, faults: int, workers: int, noise: str = "") -> None:
    """Count the chosen studies, group by group, and keep the counts of each as it is done."""
    for names in groups(chosen):
        every = [cell for name in names for cell in chosen[name].cells if noise in ("", cell.noise)]
        found = rates(every, lambda cell: draws(cell, trials, faults), workers)
        for name in names:
            kept, cells = read_counts(name), chosen[name].cells
            counted = {cell.key: dict(found[cell].words) for cell in cells if cell in found}
            write_counts(name, {cell.key: (kept | counted)[cell.key] for cell in cells if cell.key in kept | counted})
        print(f"counted: {', '.join(names)}", flush=True)


def groups(chosen: dict[str, Study]) -> list[list[str]]:
    """Studies that share samples stand together, the groups with the fewest cells first."""
    found: list[tuple[set[object], list[str]]] = []
    for name, study in chosen.items():
        samples: set[object] = {cell.sample for cell in study.cells}
        kin = [group for group in found if group[0] & samples]
        found = [group for group in found if group not in kin]
        found.append((samples.union(*(s for s, _ in kin)), [*(n for _, names in kin for n in names), name]))
    return [names for _, names in sorted(found, key=lambda group: len(group[0]))]


def rates_of(study: Study, counts: Counts) -> dict[Cell, Rate]:
    """The rates that are kept of a study."""
    return {c: Rate(tuple(counts[c.key].items()), c.counted) for c in study.cells if c.key in counts}


def read_counts(name: str) -> Counts:
    """What is kept of a study, empty at first."""
    path = KEPT / f"{name}.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}


def write_counts(name: str, counts: Counts) -> None:
    """Keep it, a line a cell."""
    lines = ",\n".join(f" {json.dumps(key)}: {json.dumps(words, sort_keys=True)}" for key, words in counts.items())
    KEPT.mkdir(exist_ok=True)
    (KEPT / f"{name}.json").write_text(f"{{\n{lines}\n}}\n", encoding="utf-8")


if __name__ == "__main__":
    raise SystemExit(main())
