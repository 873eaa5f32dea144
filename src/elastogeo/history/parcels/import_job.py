"""The job `import`: the tests of a parcel that a person confirmed come into the history."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from elastogeo.history.work import Work, job

if TYPE_CHECKING:
    from elastogeo.history.history import Added


@job("import")
def import_(work: Work, asked: dict[str, Any]) -> dict[str, Any]:
    """Import every test of the parcel `parcel`; one that is refused is told, the others come in.

    `machines` names the machine by the serial number that tests say, `""` for those that say none; `date` is the day of
    those that say none; `known` are the tests that the history had before, so that the same is told when it is done again.

    Returns
    -------
    dict
        `tests`: [{path, test, name, machine, machine_key, series, at, new, state, sentence, notes}],
        `campaigns`: [sentence], `errors`: [sentence].
    """
    from elastogeo.formats import confined_to
    from elastogeo.history.history import History
    from elastogeo.history.parcels.look_job import laid_out

    top = laid_out(work.store.files, asked["parcel"])
    history = History.of(work.store, work.who)
    result: dict[str, Any] = {"tests": [], "campaigns": [], "errors": []}
    with confined_to(top):
        for added in _brought(work, history, top, asked):
            _note(result, history, added, top, set(asked.get("known", ())))
    return result


def _brought(work: Work, history: Any, top: Path, asked: dict[str, Any]) -> Iterator[Added]:
    """What becomes of each test, the oldest first, and of each campaign after its tests."""
    from elastogeo.errors import ElastogeoError, StoreError
    from elastogeo.history.history import Added
    from elastogeo.history.parcels.recognising import CAMPAIGN, said, tests_of

    tests = tests_of(top)
    chosen = asked.get("machines", {})
    for number, (place, serial, instrument) in enumerate(tests):
        work.step(f"importing {said(place, top)}", number, len(tests))
        try:
            of, day = chosen.get(serial), asked.get("date", "")
            name = f"upload: {said(place, top)}"
            yield history.add(place, machine=of, undated=day, instrument=instrument, source=name)
        except StoreError:
            raise
        except ElastogeoError as error:
            yield Added(place, None, error=str(error))
    for file in sorted(top.rglob(CAMPAIGN)):  # their tests are known now: nothing of them is changed
        work.step(f"keeping the campaign {said(file.parent, top)}", len(tests), len(tests))
        try:
            yield from (one for one in history.add_all(file.parent) if one.imported is None)
        except StoreError:
            raise
        except ElastogeoError as error:
            yield Added(file, None, error=str(error))


def _note(result: dict[str, Any], history: Any, added: Added, top: Path, known: set[int]) -> None:
    """What is told of one test or campaign."""
    from elastogeo.history.parcels.recognising import in_the_senders_words, said
    from elastogeo.report import view_of

    got = added.imported
    if got is None:
        told = in_the_senders_words(added.error, top)
        if told and told not in result["errors"]:
            result["errors"].append(told)
        elif added.campaign:
            result["campaigns"].append(added.campaign)
        return
    keys = {one.name: one.key for one in history.machines()}
    result["tests"].append(
        {
            "path": said(added.path, top),
            "test": got.test,
            "name": got.name,
            "machine": got.machine,
            "machine_key": keys.get(got.machine),
            "series": got.series_name,
            "at": got.at.isoformat(),
            "new": got.test not in known,
            "state": added.verdict.state if added.verdict else "",
            "sentence": view_of(added.verdict).sentence if added.verdict else "",
            "notes": [note for note in (added.unanalysed, *got.notes) if note],
        }
    )
