"""The view of what a test can and cannot distinguish."""

from __future__ import annotations

from elastogeo.identification import Explanation
from elastogeo.planning import Reach, reach_of
from elastogeo.report.ceilings import reach_words
from elastogeo.report.head import campaign_head
from elastogeo.report.identification.explanation_document import explanation_json
from elastogeo.report.identification.inseparable import inseparable_words, unasked_words
from elastogeo.report.identification.reciprocity import reciprocity_words
from elastogeo.report.identification.tests import step_table
from elastogeo.report.identification.words import confounding_words
from elastogeo.report.numbers import pretty
from elastogeo.report.text import combination
from elastogeo.report.view import KeyValue, Section, Table, View, views


@views(Explanation)
def explanation_view(explained: Explanation) -> View:
    """All that is shown of an explanation."""
    campaign, found = explained.campaign, explained.confounding
    asked = len(found.labels)
    rows = tuple((name, pretty(combination(found.stands_for(name)))) for name in found.retained)
    table = Table(("parameter", "stands for"), rows, words=(0, 1), title="What is determined")
    unasked = unasked_words(campaign, found) if explained.family else ()
    words = tuple(map(pretty, (*confounding_words(found), *inseparable_words(campaign, found), *unasked)))
    groups = tuple(f"Always together: {', '.join(group)}" for group in found.groups if len(group) > 1)
    bought = () if explained.reciprocity is None else (pretty(reciprocity_words(explained.reciprocity)),)
    steps = (step_table(explained),) if explained.steps else ()
    these = "these tests determine" if campaign.several else "this test determines"
    answer = (
        f"All {asked} parameters are determined."
        if found.rank == asked
        else f"{asked} parameters, of which {these} {found.rank} combinations."
    )
    reach = reach_of(explained)
    words += () if reach is None else (reach_words(reach),)
    document = explanation_json(explained, reach)
    return View(
        kind="What a test distinguishes",
        title=campaign.machine.name,
        subtitle=campaign.name,
        origin="",
        head=campaign_head(campaign),
        sentence=answer,
        values=(
            KeyValue("rank", f"{found.rank} of {asked}"),
            *_bound(reach),
            KeyValue("condition number, scaled columns", f"{found.condition_scaled:.4g}"),
            KeyValue("changes no reading", str(len(found.null)), "parameters"),
        ),
        document=document,
        rows=document["retained"],
        tables=(*steps, table),
        notes=(*words, *groups, *bought),
        sections=(Section("What this test distinguishes", words, tables=(*steps, table), points=(*groups, *bought)),),
    )


def _bound(reach: Reach | None) -> tuple[KeyValue, ...]:
    if reach is None:
        return ()
    meaning = f"with such tests; {reach.of_any} with any between tool and workpiece"
    return (KeyValue("rank of the compliances", f"{reach.rank} of at most {reach.of_family}", meaning=meaning),)
