"""What no test between tool and workpiece tells apart, why, and what would."""

from __future__ import annotations

from elastogeo.estimate import Confounding
from elastogeo.machine import Machine
from elastogeo.report.identification.words import listed
from elastogeo.sources import alike_at_the_tool


def inseparable_words(machine: Machine, found: Confounding) -> tuple[str, ...]:
    """Compliances of joints in a row that these readings show in one sum, in a sentence; nothing if there are none."""
    together = [
        names
        for alike in alike_at_the_tool(machine)
        for group in found.groups
        if len(names := tuple(name for name in alike if name in group)) > 1
    ]
    if not together:
        return ()
    first, *others = together
    more = f", nor {len(others)} more such {'sum' if len(others) == 1 else 'sums'}" if others else ""
    return (
        f"No test between tool and workpiece distinguishes {listed(first)}{more}: no rotary axis lies between them, "
        f"so that the same force displaces the tool alike through each, at every pose. A displacement probe across "
        f"a joint, at the origin of its carriage's frame (joint-probe), distinguishes it.",
    )
