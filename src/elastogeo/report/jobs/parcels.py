"""What was sent and what came in, as tables: of the jobs `look` and `import`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from elastogeo.report.view import Table

Result = Mapping[str, Any]


def looked_at(result: Result) -> tuple[str, tuple[Table, ...]]:
    """What a parcel holds, in a sentence and as tables: its tests, then what is no test."""
    tests = result["tests"]
    new = [one for one in tests if not one["known"]]
    known = len(tests) - len(new)
    parts = [
        f"{_tests(len(new))} to import" if new else "",
        f"{_tests(known)} known already" if known else "",
        f"{len(result['errors'])} that cannot be read" if result["errors"] else "",
    ]
    said = ", ".join(part for part in parts if part)
    if not tests:
        sentence = "No test was found in what was sent."
    elif not new:
        sentence = f"{_tests(known).capitalize()} known already: nothing was changed."
    else:
        sentence = f"{said[:1].upper()}{said[1:]}."
    tables = []
    if tests:
        rows: tuple[tuple[str, ...], ...] = tuple(
            (one["name"], one["path"], _kind(one), _machine(one), one["date"] or "not said", _then(one)) for one in tests
        )
        heads = ("test", "sent as", "kind", "machine", "measured", "")
        keys = tuple((one["known"] or {}).get("test", "") for one in tests)
        tables.append(Table(heads, rows, words=(0, 1, 2, 3, 4, 5), title="Tests", name="tests", keys=keys))
    if result["others"]:
        files = tuple((one["path"], one["what"] or "no test", one["error"]) for one in result["others"])
        note = f"{result['more']} more files." if result["more"] else ""
        said_of = ("sent as", "is", "why it is not imported")
        tables.append(Table(said_of, files, words=(0, 1, 2), title="Other files", note=note, name="others"))
    return sentence, tuple(tables)


def came_in(result: Result) -> tuple[str, tuple[Table, ...]]:
    """What became of the tests of a parcel, in a sentence and as a table."""
    tests, refused = result["tests"], len(result["errors"])
    new = sum(one["new"] for one in tests)
    known = len(tests) - new
    parts = [f"{new} new" if new else "", f"{known} known already" if known else "", f"{refused} refused" if refused else ""]
    said = ", ".join(part for part in parts if part)
    sentence = f"{said[:1].upper()}{said[1:]}." if said else "Nothing came in."
    if known and not new and not refused:
        sentence = f"{_tests(known).capitalize()} known already: nothing was changed."
    rows = tuple(
        (one["name"], one["machine"], one["at"][:10], one["series"], one["state"], "" if one["new"] else "known already")
        for one in tests
    )
    heads = ("test", "machine", "measured", "series", "state of the series", "")
    keys = tuple(one["test"] for one in tests)
    table = Table(heads, rows, words=(0, 1, 2, 3, 4, 5), title="Tests", name="tests", keys=keys)
    return sentence, (table,) if rows else ()


def waits_for_a_person(result: Result) -> bool:
    """Whether a parcel holds a test that is not in the history yet."""
    return any(not one["known"] for one in result.get("tests", ()))


def simulated(result: Result) -> str:
    """From what tests of a parcel are simulated or reconstructed; empty if they were measured."""
    origins = sorted({one["origin"] for one in result.get("tests", ()) if one.get("origin", "measured") != "measured"})
    whole = all(one.get("origin", "measured") != "measured" for one in result.get("tests", ()))
    said = " and ".join(origins)
    return f"{said[:1].upper()}{said[1:]} data{'' if whole else ' among them'}" if said else ""


def _tests(count: int) -> str:
    return "one test" if count == 1 else f"{count} tests"


def _kind(one: Result) -> str:
    kind = one["kind"].replace("-", " ")
    return f"{kind}, {one['origin']}" if one["origin"] != "measured" else kind


def _machine(one: Result) -> str:
    if one["known"]:
        return str(one["known"]["machine"])
    if one["machine"]:
        return str(one["machine"])
    model = f" ({one['model']})" if one["model"] else ""
    return f"serial number {one['serial']}, not known here{model}" if one["serial"] else f"not said{model}"


def _then(one: Result) -> str:
    return f"known already: test {one['known']['test']}" if one["known"] else "new"
