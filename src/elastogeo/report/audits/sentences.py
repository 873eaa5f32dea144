"""What the checks of an audit trail, and of a whole history, say."""

from __future__ import annotations

from elastogeo.changes import (
    DATABASE_SOUND,
    DOCUMENTS_WHOLE,
    NO_STRAY_FILES,
    RAW_FILES_WHOLE,
    RECORDS_AGREE,
    REFERENCES_WHOLE,
    ROWS_PROTECTED,
    TRAIL_WHOLE,
)
from elastogeo.report.sentences import Facts, says

_FAULTS = {
    "changed": "row {0} was changed",
    "missing": "row {0} was deleted",
    "moved": "row {0} stood at {1}",
    "cut off": "the rows from {0} on were cut off",
    "head missing": "its end, row {0}, is not confirmed",
}


@says(TRAIL_WHOLE)
def trail_whole(facts: Facts, passed: bool | None) -> str:
    """Every row as it was written, or which are not."""
    if passed:
        return f"Every row has the seal of its content and of the row before; rows: {facts['rows']}."
    if passed is None:
        return f"Not looked at; rows: {facts['rows']}."
    named = [_FAULTS[fault].format(number, was) for number, fault, was in facts["first"]]
    more = sum(facts["faults"].values()) - len(named)
    rest = f", and {more} more" if more else ""
    return f"Not as it was written: {', '.join(named)}{rest}. Compare it with a backup."


_OF_A_HISTORY = {
    "unreadable": "{0} cannot be read",
    "unprotected": "{0} could be changed",
    "dangling": "{0} names what is not there",
    "missing": "{0} is missing",
    "changed": "{0} was changed",
    "resized": "{0} has another size",
    "stray": "{0} is named by no row",
}


def _said(facts: Facts, passed: bool | None, whole: str, todo: str) -> str:
    if passed:
        return whole.format(facts["checked"])
    if passed is None:
        return "Not tested: the database cannot be read."
    named = [
        _OF_A_HISTORY[fault].format(subject) + (f" ({detail})" if detail else "")
        for subject, fault, detail in facts["first"]
    ]
    more = facts["faults"] - len(named)
    return f"{', '.join(named)}{f', and {more} more' if more else ''}. {todo}"


@says(DATABASE_SOUND)
def database_sound(facts: Facts, passed: bool | None) -> str:
    """Whether every row can be read."""
    return _said(facts, passed, "Every row can be read; rows: {}.", "Restore the last backup.")


@says(ROWS_PROTECTED)
def rows_protected(facts: Facts, passed: bool | None) -> str:
    """Whether the database refuses changes."""
    return _said(
        facts, passed, "The database refuses to change what was written; tables: {}.", "Export it and restore the export."
    )


@says(REFERENCES_WHOLE)
def references_whole(facts: Facts, passed: bool | None) -> str:
    """Whether every row that is named is there."""
    return _said(facts, passed, "Every row that another names is there; references: {}.", "Compare it with a backup.")


@says(RAW_FILES_WHOLE)
def raw_files_whole(facts: Facts, passed: bool | None) -> str:
    """Whether every raw file has its hash and size."""
    return _said(
        facts, passed, "Every raw file has its hash and size; files: {}.", "Put the files back from a backup, by name."
    )


@says(DOCUMENTS_WHOLE)
def documents_whole(facts: Facts, passed: bool | None) -> str:
    """Whether every document can be unpacked and has its hash."""
    return _said(
        facts,
        passed,
        "Every document can be read and has its hash; documents: {}.",
        "Compare it with a backup, or recompute.",
    )


@says(RECORDS_AGREE)
def records_agree(facts: Facts, passed: bool | None) -> str:
    """Whether tests and analyses are what their files and the trail say."""
    return _said(
        facts, passed, "Tests and analyses are what the audit trail says of them; records: {}.", "Compare it with a backup."
    )


@says(NO_STRAY_FILES)
def no_stray_files(facts: Facts, passed: bool | None) -> str:
    """Whether every file is named by a row."""
    return _said(
        facts,
        passed,
        "Every raw file is named by a row; files: {}.",
        "Harmless: an import that goes on or was cut off leaves such files.",
    )
