"""Whether the model as asked is supported, and what is named where it lacks something."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from studies.bar_tests import LOADED, SET_ANEW
from studies.noise import NOISES
from studies.rates import NOT_TESTED, Study, cells
from studies.truth import FOUR_LOBE, Truth

CHECK = "model adequate"
KEPT, FOUND, TOGETHER, ANOTHER = "kept", "found", "named together", "another named"
"""What is said of a fault: nothing; it alone; it, and what the layout cannot distinguish from it; something else."""

LINEAR = ("force bend", "every compliance alike", "CF1_", "linear")
CONTACT = ("every contact alike", "contact", "H_")
GEOMETRY = ("E_", "ball form", "geometry")
SURE, RUN = "white", "of the run"
SHARE = 4.0
"""Of the draws that a fault gets: as many as where nothing is wrong."""


@dataclass(frozen=True)
class Named:
    """Judge: whether the models that are named with the supported one are of a kind.

    Attributes
    ----------
    kind : tuple of str
        What the names of its columns begin with.
    """

    kind: tuple[str, ...]

    def __call__(self, result: Any) -> str:
        """`kept`, `found`, `named together`, `another named` or `not tested`."""
        models = result.models
        if models is None or models.supported is None:
            return NOT_TESTED
        if models.constant:
            return KEPT
        right = [all(label.startswith(self.kind) for label in models.of(name).added) for name in models.alike]
        return FOUND if all(right) else TOGETHER if any(right) else ANOTHER


def found(
    truth: str, drawn: Truth, kind: tuple[str, ...], noises: tuple[str, ...] = (SURE, RUN), least: float = 0.95
) -> Any:
    """Cells of a fault that is to be named."""
    short = {("7 runs", SURE): 8, ("15 runs", RUN): 8} if least else {}
    counted = (FOUND, TOGETHER)
    return cells(
        CHECK, truth, LOADED, noises, drawn, judge=Named(kind), counted=counted, least=least, share=SHARE, short=short
    )


STUDY = Study(
    CHECK,
    "Columns of geometry, compliance, force and set-up are tested one by one, runs counting as independent, and combined at "
    "5 %. A fault counts as found if its kind is named, alone (`found`) or with what the layout cannot distinguish from it "
    "(`named together`). An offset of the force and a set-up that is merely soft look like geometry and compliance; nothing "
    "shows them here.",
    (
        *cells(
            CHECK,
            "a constant compliance",
            LOADED,
            (*NOISES, SET_ANEW),
            most=0.05,
            short={("7 runs", SURE): 12, ("15 runs", RUN): 12},
        ),
        *found("every compliance falls by 20 %", Truth(softening=-0.2), LINEAR),
        *found("a contact law carries 30 %", Truth(contact=0.3), CONTACT),
        *found("a four-lobe of -13.5 um at every force", Truth(four_lobe=FOUR_LOBE), GEOMETRY),
        *found("the force bends by 20 %", Truth(force_bend=0.2), LINEAR),
    ),
)
