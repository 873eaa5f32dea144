"""Campaigns of a history: the raw records asked together say what the files on disk do."""

import tomllib

import pytest
from sqlalchemy import select

import elastogeo as eg
from elastogeo.errors import FormatError, InputError
from elastogeo.history.analyses import campaign_text, campaigns, keep_campaign, kept_campaign, recompute_campaign
from elastogeo.history.analyses import kept_campaigns as module
from elastogeo.history.store import Store, audit, read, schema
from tests.history.analyses.kept import EXAMPLES, files_of, keep_series, keep_test

FOLDER = EXAMPLES / "three-axis-campaign"
ASKED = ["C_XXX", "C_YYY", "C_ZZZ"]


def keep_two(store: Store) -> dict[str, int]:
    """Two tests of one machine, whose machine file lies beside their folders."""
    series = keep_series(store)
    machine = {"../machine.toml": (FOLDER / "machine.toml").read_bytes()}
    return {name: keep_test(store, series, files_of(FOLDER / name) | machine, name=name) for name in ("1-xy", "2-yz")}


def test_tests_asked_together_from_the_store_say_what_their_files_say(store: Store) -> None:
    tests = keep_two(store)
    kept = keep_campaign(store, campaign_text("spring", tests, ASKED), tests, "A. Miller")
    direct = eg.identify({name: eg.read_test(FOLDER / name) for name in tests}, parameters=ASKED).to_dict()
    assert kept.document is not None
    assert kept.document["parameters"] == direct["parameters"]
    assert {one["name"] for one in direct["parameters"]} >= set(ASKED)
    assert (kept.name, kept.machine, kept.tests, kept.software) == ("spring", "Mill 3", tests, eg.__version__)
    with read(store) as connection:
        assert campaigns(connection) == (kept.key,)
        assert kept_campaign(connection, kept.key) == kept
        members = connection.execute(select(schema.campaign_test.c.test)).scalars().all()
        assert sorted(members) == sorted(tests.values())
        assert audit.verify(connection) == ()
    again = recompute_campaign(store, kept.key)
    assert (again.same_bits, again.differing) == (True, ())


def test_a_new_version_replaces_what_the_old_said_and_the_trail_has_both(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    said = {"C_XXX": 1.0}
    monkeypatch.setattr(module, "_identified", lambda *_: identified(said["C_XXX"]))
    tests = keep_two(store)
    kept = keep_campaign(store, campaign_text("spring", tests), tests)
    said["C_XXX"] = 2.0
    same_version = recompute_campaign(store, kept.key)
    assert same_version.same_bits is False
    assert [(entry.path, entry.old, entry.new) for entry in same_version.differing] == [("document.C_XXX", "1.0", "2.0")]
    assert same_version.document == {"C_XXX": 1.0}
    monkeypatch.setattr(module, "_identified", lambda *_: identified(said["C_XXX"], "99.0"))
    new = recompute_campaign(store, kept.key, "A. Miller")
    assert (new.software, new.document, new.same_bits) == ("99.0", {"C_XXX": 2.0}, None)
    with read(store) as connection:
        assert kept_campaign(connection, kept.key).document == {"C_XXX": 2.0}
        row = connection.execute(select(schema.audit).order_by(schema.audit.c.number.desc())).mappings().first()
        assert row is not None
        assert (row["who"], row["old"]["software"], row["new"]["software"]) == ("A. Miller", eg.__version__, "99.0")


def identified(value: float, software: str = eg.__version__) -> dict[str, object]:
    facts = {"inputs_sha256": "i", "supported": True, "error": "", "settings": {}}
    return facts | {"campaign": "", "software": software, "document_sha256": str(value), "document": {"C_XXX": value}}


def test_a_name_is_given_once_to_a_machine(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_identified", lambda *_: identified(1.0))
    tests = keep_two(store)
    keep_campaign(store, campaign_text("spring", tests), tests)
    with pytest.raises(InputError, match="has a campaign 'spring' already; give this one another name"):
        keep_campaign(store, campaign_text("spring", tests), tests)


def test_what_cannot_be_asked_together_is_refused_with_the_reason(store: Store) -> None:
    tests = keep_two(store)
    with pytest.raises(InputError, match=r"'spring' says nothing that could be kept: .*C_QQQ"):
        keep_campaign(store, campaign_text("spring", tests, ["C_QQQ"]), tests)
    with read(store) as connection:
        assert campaigns(connection) == ()


def test_tests_of_two_machines_are_no_campaign(store: Store) -> None:
    one = keep_test(store, keep_series(store, "Mill 3"), {"test.toml": b"a"})
    two = keep_test(store, keep_series(store, "Mill 4"), {"test.toml": b"b"})
    with pytest.raises(InputError, match="of several machines"):
        keep_campaign(store, campaign_text("spring", ["a", "b"]), {"a": one, "b": two})


@pytest.mark.parametrize(
    ("text", "error", "message"),
    [
        ("name = 7 seven", FormatError, "this is no campaign file"),
        ('name = "a"', FormatError, "has a name and tests"),
        ('name = "a"\ntests = ["../xy"]', FormatError, "names the test '../xy'"),
        ('name = "a"\ntests = ["xy", "yz"]', InputError, "names the tests xy, yz, given are xy"),
    ],
)
def test_a_campaign_file_that_will_not_do_is_refused(store: Store, text: str, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        keep_campaign(store, text, {"xy": 1})


def test_a_test_that_is_not_there_is_named(store: Store) -> None:
    with pytest.raises(InputError, match="there is no test 7 for 'xy'"):
        keep_campaign(store, campaign_text("spring", ["xy"]), {"xy": 7})


def test_a_campaign_that_is_not_there_is_refused(store: Store) -> None:
    with pytest.raises(InputError, match="there is no campaign 7"):
        recompute_campaign(store, 7)


def test_the_name_of_a_campaign_may_hold_anything_that_text_holds() -> None:
    name = 'spring "2026" \\ µm\n'
    assert tomllib.loads(campaign_text(name, ["xy"], ["C_*"])) == {
        "schema": "elastogeo.campaign/1", "name": name, "tests": ["xy"], "question": {"parameters": ["C_*"]},
    }  # fmt: skip
