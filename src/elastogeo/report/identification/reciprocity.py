"""What assuming the symmetry of every joint buys, in words."""

from __future__ import annotations

from elastogeo.identification import Reciprocity


def reciprocity_words(bought: Reciprocity) -> str:
    """What assuming the symmetry of every joint buys."""
    free, symmetric, pairs = bought.free, bought.symmetric, len(bought.pairs)
    if not pairs:
        return "No compliance was asked for together with its mirror, so reciprocity merges nothing."
    left = [len(found.labels) - found.rank for found in (free, symmetric)]
    new = [name for name in bought.alone_symmetric if name not in bought.alone_free]
    named = f" Determined by themselves only with it: {', '.join(new)}." if new else ""
    see = f"{bought.testable} combination{'' if bought.testable == 1 else 's'}"
    tested = (
        f"The observations see {see} of the differences between mirrors and so test the assumption."
        if bought.testable
        else "The observations see no difference between mirrors, so they cannot test the assumption."
    )
    return (
        f"Reciprocity merges {pairs} pair{'' if pairs == 1 else 's'}, {len(free.labels)} parameters into "
        f"{len(symmetric.labels)}. The rank is {free.rank} without it and {symmetric.rank} with it; {left[0]} and {left[1]} "
        f"unknowns stay undetermined. {tested}{named}"
    )
