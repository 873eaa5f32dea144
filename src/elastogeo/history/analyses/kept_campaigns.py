"""Campaigns: tests of one machine that are kept as a set, identified together from their raw records.

What is asked of them is kept as a campaign file, whose `tests` are names of folders; in the store each name stands for a
test. Nothing else is stored of the tests: they are laid out again beside that file.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from typing import Any, cast

from sqlalchemy import Connection, insert, select, update

from elastogeo.changes import Differing, KeptCampaign
from elastogeo.errors import ElastogeoError, FormatError, InputError, StoreError, several
from elastogeo.formats import CampaignParts, confined_to, read_campaign
from elastogeo.history.analyses.analysing import PROGRAM
from elastogeo.history.analyses.computation import made_with, sha256_of
from elastogeo.history.analyses.differences import differences
from elastogeo.history.analyses.raw import RawFile, lay_out, most_up, raw_files
from elastogeo.history.analyses.verbs import SEED
from elastogeo.history.series_of import days
from elastogeo.history.store import Files, Store, audit, now, read, write
from elastogeo.history.store.schema import campaign, campaign_test, machine, series, test
from elastogeo.identification import identify
from elastogeo.report import view_of
from elastogeo.version import VERSION

CAMPAIGN = "campaign.toml"


def campaign_text(name: str, tests: Iterable[str], parameters: Iterable[str] = ()) -> str:
    """A campaign file that asks tests together: for their own parameters, or for these."""
    lines = ['schema = "elastogeo.campaign/1"', f"name = {json.dumps(name)}", f"tests = {json.dumps(list(tests))}"]
    asked = list(parameters)
    return "\n".join([*lines, *(["", "[question]", f"parameters = {json.dumps(asked)}"] if asked else []), ""])


def keep_campaign(store: Store, text: str, tests: Mapping[str, int], who: str = PROGRAM) -> KeptCampaign:
    """Keep tests of one machine as a set, with what they say together.

    Parameters
    ----------
    store : Store
    text : str
        Of the campaign file: its name is that of the campaign.
    tests : mapping of str to int
        Keys of the tests, by what the file calls their folders.
    who : str
        For the audit trail.

    Raises
    ------
    FormatError
        If the text is no campaign file.
    InputError
        If the file names other tests than are given, they are not of one machine of the history, the machine has a campaign
        of this name already, or they cannot be asked together.
    StoreError
        If a raw file is missing or damaged, or nothing can be written.
    """
    document = _document(text)
    if set(document["tests"]) != set(tests):
        raise InputError(
            f"the campaign names the tests {', '.join(document['tests'])}, given are {', '.join(tests) or 'none'}; "
            "import each test that it names"
        )
    with read(store) as connection:
        owner = _machine_of(connection, tests)
        _check_name(connection, owner, document["name"])
        raw = {folder: raw_files(connection, key) for folder, key in tests.items()}
    content = _identified(store.files, text, raw) | {"tests": dict(tests)}
    if content["error"]:
        raise InputError(f"campaign {document['name']!r} says nothing that could be kept: {content['error']}")
    with write(store) as connection:
        _check_name(connection, owner, document["name"])
        row = {"machine": owner, "name": document["name"], "made_at": now(), "content": content}
        key = int(connection.execute(insert(campaign).values(**row).returning(campaign.c.id)).scalar_one())
        members = [{"campaign": key, "test": one} for one in sorted(set(tests.values()))]
        connection.execute(insert(campaign_test), members)
        new = {"name": document["name"], "tests": dict(tests), "document_sha256": content["document_sha256"]}
        audit.record(connection, who, "keep campaign", f"campaign {key}", new=new)
        return kept_campaign(connection, key)


def keep_parts(store: Store, parts: CampaignParts, keys: Mapping[str, int], who: str = PROGRAM) -> tuple[str, str]:
    """Keep a campaign whose tests were imported, once.

    Parameters
    ----------
    store : Store
    parts : CampaignParts
    keys : mapping of str to int
        Of its tests that are in the history, by what its file calls them.
    who : str

    Returns
    -------
    str
        What became of it; empty if it was not kept.
    str
        Why it was not.
    """
    missing = [said for said in parts.tests if said not in keys]
    if missing:
        return "", f"{parts.file}: is not kept, since its tests did not all come in: {several(missing)}"
    with read(store) as connection:
        every = [kept_campaign(connection, key) for key in campaigns(connection)]
    same = next((one for one in every if one.name == parts.name and dict(one.tests) == dict(keys)), None)
    if same:
        return f"Campaign {same.key} is known, nothing was changed: {same.name}", ""
    try:
        kept = keep_campaign(store, parts.text, keys, who)
    except StoreError:
        raise
    except ElastogeoError as error:
        return "", f"{parts.file}: {error}"
    return f"Campaign {kept.key}: {kept.name}, {len(keys)} tests, {kept.machine}", ""


def recompute_campaign(store: Store, key: int, who: str = PROGRAM) -> KeptCampaign:
    """Identify the tests of a campaign again: what differs by the same version; what a new version says replaces the old.

    Raises
    ------
    InputError
        If there is no such campaign.
    StoreError
        If a raw file is missing or damaged, or nothing can be written.
    """
    with read(store) as connection:
        old = _content(connection, key)
        raw = {folder: raw_files(connection, one) for folder, one in old["tests"].items()}
    found = _identified(store.files, old["campaign"], raw) | {"tests": old["tests"]}
    if found["software"] == old["software"]:
        same = found["document_sha256"] == old["document_sha256"] and found["error"] == old["error"]
        with read(store) as connection:
            kept = kept_campaign(connection, key)
        return replace(kept, same_bits=same, differing=() if same else _apart(old, found))
    with write(store) as connection:
        connection.execute(update(campaign).where(campaign.c.id == key).values(content=found))
        audit.record(connection, who, "recompute", f"campaign {key}", _facts(old), _facts(found))
        return replace(kept_campaign(connection, key), differing=_apart(old, found))


def campaigns(connection: Connection, of: int | None = None) -> tuple[int, ...]:
    """Keys of the campaigns of a machine, or of all, in the order in which they were kept."""
    asked = select(campaign.c.id).order_by(campaign.c.id)
    return tuple(connection.execute(asked if of is None else asked.where(campaign.c.machine == of)).scalars())


def kept_campaign(connection: Connection, key: int) -> KeptCampaign:
    """A campaign as it is kept.

    Raises
    ------
    InputError
        If there is none.
    """
    content = _content(connection, key)
    row = connection.execute(
        select(campaign.c.name, campaign.c.made_at, machine.c.name.label("machine"))
        .join(machine, machine.c.id == campaign.c.machine)
        .where(campaign.c.id == key)
    ).one()
    return KeptCampaign(
        key=key,
        machine=row.machine,
        name=row.name,
        made_at=days(row.made_at),
        software=content["software"],
        tests=content["tests"],
        supported=content["supported"],
        error=content["error"],
        document=content["document"],
    )


def _identified(files: Files, text: str, raw: Mapping[str, Sequence[RawFile]]) -> dict[str, Any]:
    """What the tests say together, as it is kept."""
    settings = {"verb": "identify", "seed": SEED}
    document, supported, error = None, False, ""
    with beside(files, text, raw) as top:
        try:
            view = view_of(identify(read_campaign(top)))
            document, supported = dict(view.document), view.supported
        except ElastogeoError as caught:
            error = str(caught).replace(f"{top}/", "")
    inputs = {name: {file.path: file.sha256 for file in found} for name, found in raw.items()}
    return {
        "campaign": text,
        "software": VERSION,
        "settings": settings | {"made_with": made_with()},
        "inputs_sha256": sha256_of({"campaign": text, "files": inputs, "settings": settings}),
        "supported": supported,
        "error": error,
        "document_sha256": None if document is None else sha256_of(document),
        "document": document,
    }


@contextmanager
def beside(files: Files, text: str, raw: Mapping[str, Sequence[RawFile]]) -> Iterator[Path]:
    """The tests in folders of their names beside the campaign file."""
    up = max((most_up(found) for found in raw.values()), default=0)
    with TemporaryDirectory(prefix="elastogeo-", ignore_cleanup_errors=True) as made:
        top = Path(made).resolve().joinpath(*["up"] * up, "campaign")
        for name, found in raw.items():
            lay_out(files, found, top / name)
        (top / CAMPAIGN).write_text(text, encoding="utf-8")
        with confined_to(Path(made).resolve()):
            yield top


def _document(text: str) -> dict[str, Any]:
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise FormatError(f"this is no campaign file: {error}; write one as `elastogeo plan --write` does") from None
    tests, name = document.get("tests"), document.get("name")
    if not isinstance(tests, list) or not tests or not isinstance(name, str) or not name:
        raise FormatError('a campaign file has a name and tests: name = "spring", tests = ["xy", "yz"]')
    for folder in tests:
        if not isinstance(folder, str) or len(PurePosixPath(folder).parts) != 1 or folder in ("..", "."):
            raise FormatError(f'the campaign names the test {folder!r}; a history keeps tests by folder names: "xy"')
    return document


def _machine_of(connection: Connection, tests: Mapping[str, int]) -> int:
    asked = select(test.c.id, series.c.machine).join(series, series.c.id == test.c.series)
    owners = {row.id: row.machine for row in connection.execute(asked.where(test.c.id.in_(tests.values())))}
    lost = [name for name, key in tests.items() if key not in owners]
    if lost:
        raise InputError(f"there is no test {tests[lost[0]]} for {lost[0]!r} of the campaign; import it first")
    if len(set(owners.values())) > 1:
        raise InputError("the tests of this campaign are of several machines of the history; a campaign is of one")
    return int(next(iter(owners.values())))


def _check_name(connection: Connection, owner: int, name: str) -> None:
    asked = select(campaign.c.id).where(campaign.c.machine == owner, campaign.c.name == name)
    if connection.execute(asked).scalar_one_or_none() is not None:
        raise InputError(f"this machine has a campaign {name!r} already; give this one another name")


def _content(connection: Connection, key: int) -> dict[str, Any]:
    found = connection.execute(select(campaign.c.content).where(campaign.c.id == key)).scalar_one_or_none()
    if found is None:
        raise InputError(f"there is no campaign {key}; `elastogeo history list` shows those that there are")
    return cast("dict[str, Any]", found)


def _apart(old: Mapping[str, Any], new: Mapping[str, Any]) -> tuple[Differing, ...]:
    return differences(*({name: one[name] for name in ("document", "error", "supported")} for one in (old, new)))


def _facts(content: Mapping[str, Any]) -> dict[str, Any]:
    return {name: content[name] for name in ("software", "inputs_sha256", "document_sha256", "error")}
