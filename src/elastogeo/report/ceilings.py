"""What no test between tool and workpiece tells, why, and what would, in words; how far tests are from the best."""

from __future__ import annotations

from elastogeo.machine import COMPONENTS
from elastogeo.observe import BAR, PROBES
from elastogeo.planning import Exchange, Probe, Reach, Reason, Remedy
from elastogeo.report.text import MOST_TERMS, combination, listed

_DISPLACEMENT = ("a translation in", "a rotation about")
_LOAD = ("a force in", "a moment about")
_FAMILY = {BAR: "forces and readings along one line", PROBES: "forces and displacements in any direction"}
_MOST_EXCHANGES = 2


def reach_words(reach: Reach) -> str:
    """How many combinations the tests determine, of how many that such tests, and any tests, can."""
    kind = f"{_FAMILY[reach.family]} tell at most {reach.of_family}" if reach.family in _FAMILY else ""
    best = f"any test between tool and workpiece at most {reach.of_any}"
    some = "1 compliance" if reach.columns == 1 else f"{reach.columns} compliances"
    told = "1 combination is" if reach.rank == 1 else f"{reach.rank} combinations are"
    return (
        f"Of {some}, {told} determined. On this machine "
        f"{f'{kind} (with the tools of these tests), {best}' if kind else best}."
    )


def reason_words(reason: Reason) -> str:
    """Why a compliance is never known by itself from tests between tool and workpiece, and what would tell it."""
    if reason.alike:
        others = [name for name in reason.alike if name != reason.name]
        why = (
            f"{listed(others)} {'makes' if len(others) == 1 else 'make'} the same trace in every such test: what moves "
            f"between these joints changes {neither_words(reason)}."
        )
    else:
        first = reason.exchanges[:_MOST_EXCHANGES]
        more = len(reason.exchanges) - len(first)
        why = " ".join(_exchange_words(exchange, reason) for exchange in first)
        why += f" So {'does' if more == 1 else 'do'} {more} more such {'sum' if more == 1 else 'sums'}." if more else ""
    told = f" {remedy_words(reason.remedy, reason.name)}" if reason.remedy else ""
    return f"No test between tool and workpiece tells {reason.name} by itself. {why}{told}"


def remedy_words(remedy: Remedy, name: str) -> str:
    """What readings elsewhere would tell."""
    first, *others = remedy.probes
    where = f"across {first.across}, along {_axis(first)} of its carriage's frame"
    if not others:
        return (
            f"A displacement probe {where} and at that frame's origin (joint-probe) tells {name}; at any other point "
            f"rotations of {first.across} enter."
        )
    second = others[0]
    distance = max(map(abs, second.point))
    lever = "xyz"[max(range(3), key=lambda k: abs(second.point[k]))]
    return (
        f"Two displacement probes {where}, one at that frame's origin and one {distance:g} mm from it along {lever} "
        f"(joint-probe), tell {name}: their difference over the distance."
    )


def neither_words(reason: Reason) -> str:
    """The displacement and the load that are left as they are: `neither a translation in x nor a force in x`."""
    return f"neither {_said(_DISPLACEMENT, reason.displacement)} nor {_said(_LOAD, reason.load)}"


def _exchange_words(exchange: Exchange, reason: Reason) -> str:
    """Two sums that exchange unseen, and what moves between them."""
    gained, lost = (combination(terms, MOST_TERMS) for terms in (exchange.gained, exchange.lost))
    unchanged = neither_words(reason) if set(exchange.gained) == {reason.name} else "neither sum"
    return (
        f"{gained} and {lost} exchange unseen: {_moves(exchange)}, which changes {unchanged}, so nothing outside sees on "
        f"which side of it the machine gives way."
    )


def _moves(exchange: Exchange) -> str:
    verbs = ((exchange.turns, "turn"), (exchange.slides, "slide"))
    parts = [f"{listed(axes)} {verb}{'s' if len(axes) == 1 else ''}" for axes, verb in verbs if axes]
    return f"{' and '.join(parts)} between them" if parts else "a fixed lever lies between them"


def _said(words: tuple[str, str], component: int) -> str:
    return f"{words[component >= 3]} {'xyz'[component % 3]}"


def _axis(probe: Probe) -> str:
    return COMPONENTS[max(range(3), key=lambda k: abs(probe.sensor[k]))].lower()
