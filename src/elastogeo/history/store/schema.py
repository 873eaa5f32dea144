"""The tables. Raw, result and audit rows are written once: the database itself refuses to change or delete them (`FROZEN`).

What changes with time is a row more: a test is set aside, an alarm takes a step, a baseline follows another. Only
`series_state`, `outbox`, `job`, `drawing`, `account`, `token`, `session` and `instrument`, `machine`, `series`, `recipient`,
`plan`, `campaign` hold what may be written over.
"""

from __future__ import annotations

from sqlalchemy import (
    Boolean,
    CheckConstraint,
    Column,
    Float,
    ForeignKey,
    Index,
    Integer,
    MetaData,
    Table,
    Text,
    UniqueConstraint,
)

from elastogeo.history.store.columns import Document, Instant, Key, Packed

metadata = MetaData(
    naming_convention={
        "ix": "ix_%(table_name)s_%(column_0_N_name)s",
        "uq": "uq_%(table_name)s_%(column_0_N_name)s",
        "ck": "ck_%(table_name)s_%(constraint_name)s",
        "fk": "fk_%(table_name)s_%(column_0_N_name)s_%(referred_table_name)s",
        "pk": "pk_%(table_name)s",
    }
)


def _table(name: str, *parts: Column[object] | UniqueConstraint | CheckConstraint | Index) -> Table:
    return Table(name, metadata, Column("id", Key, primary_key=True), *parts)


def _of(name: str, table: str, optional: bool = False) -> Column[object]:
    return Column(name, Key, ForeignKey(f"{table}.id"), nullable=optional)


def _one_of(column: str, *values: str) -> CheckConstraint:
    listed = ", ".join(f"'{value}'" for value in values)
    return CheckConstraint(f"{column} IN ({listed})", name=column)


def _text(name: str) -> Column[object]:
    return Column(name, Text, nullable=False, server_default="")


# who and what
person = _table(
    "person",
    Column("name", Text, nullable=False, unique=True),
    Column("role", Text, nullable=False),
    _text("email"),
    Column("made_at", Instant, nullable=False),
    _one_of("role", "reader", "engineer", "administrator"),
)
machine = _table(
    "machine",
    Column("name", Text, nullable=False, unique=True),  # of this very machine: `Hermle C50 no. 3`
    _text("kind"),  # of its model: `hermle_c50`
    _text("serial"),
    _text("place"),  # hall or plant
    Column("made_at", Instant, nullable=False),
)
instrument = _table(
    "instrument",
    Column("serial", Text, nullable=False, unique=True),
    _text("kind"),  # `loaded-ball-bar`
    Column("made_at", Instant, nullable=False),
)
calibration = _table(
    "calibration",
    _of("instrument", "instrument"),
    Column("at", Instant, nullable=False),
    Column("due", Instant),
    _text("certificate"),
    Column("content", Document, nullable=False),
    _text("who"),
)
# what was measured
blob = Table(
    "blob",
    metadata,
    Column("sha256", Text, primary_key=True),  # the file lies under this name
    Column("size", Key, nullable=False),
    Column("made_at", Instant, nullable=False),
)
series = _table(
    "series",
    _of("machine", "machine"),
    Column("name", Text, nullable=False),
    Column("recipe", Document, nullable=False),
    Column("recipe_sha256", Text, nullable=False),
    Column("software", Text, nullable=False),  # one version a chart: all analyses that count were made with it
    Column("interval_days", Float),  # when the next test is due; None: never
    Column("grace_days", Float, nullable=False, server_default="7"),
    Column("alpha", Float, nullable=False, server_default="0.005"),
    UniqueConstraint("machine", "recipe_sha256"),
    UniqueConstraint("machine", "name"),
)
test = _table(
    "test",
    _of("series", "series"),
    Column("sha256", Text, nullable=False, unique=True),  # of the names and hashes of its files
    Column("name", Text, nullable=False),
    Column("at", Instant, nullable=False),  # when it was measured
    _text("zone"),  # as the file says it: `+01:00`; empty: taken as UTC
    Column("imported_at", Instant, nullable=False),
    Column("origin", Text, nullable=False),
    _text("from_what"),  # simulated or reconstructed from what
    Column("temperature", Float),
    _of("instrument", "instrument", optional=True),
    _of("repeats", "test", optional=True),  # the suspect test that it repeats
    _text("who"),
    Column("about", Document, nullable=False),
    _one_of("origin", "measured", "simulated", "reconstructed"),
    Index(None, "series", "at"),
)
test_file = _table(
    "test_file",
    _of("test", "test"),
    Column("path", Text, nullable=False),  # in the test's folder, with forward slashes
    Column("sha256", Text, ForeignKey("blob.sha256"), nullable=False),
    UniqueConstraint("test", "path"),
)
set_aside = _table(
    "set_aside",
    _of("test", "test"),
    Column("aside", Boolean, nullable=False),  # the last row of a test counts
    Column("at", Instant, nullable=False),
    Column("who", Text, nullable=False),
    Column("why", Text, nullable=False),
    Index(None, "test"),
)
# what it says
analysis = _table(
    "analysis",
    _of("test", "test"),
    Column("software", Text, nullable=False),
    Column("settings", Document, nullable=False),
    Column("inputs_sha256", Text, nullable=False),
    Column("made_at", Instant, nullable=False),
    Column("supported", Boolean, nullable=False),
    Column("error", Text),  # why there is none
    Column("signatures", Packed),  # how faults of the machine's components move the indicators; None where nobody knows
    Column("document_sha256", Text),
    Column("document", Packed),  # the view's JSON
    UniqueConstraint("test", "software", "inputs_sha256"),
)
indicator = _table(
    "indicator",
    _of("analysis", "analysis"),
    Column("name", Text, nullable=False),
    Column("kind", Text, nullable=False),
    Column("value", Float, nullable=False),
    Column("standard_uncertainty", Float),
    UniqueConstraint("analysis", "name"),
)
# sets of tests
campaign = _table(
    "campaign",
    _of("machine", "machine"),
    Column("name", Text, nullable=False),
    Column("made_at", Instant, nullable=False),
    Column("content", Document, nullable=False),
    UniqueConstraint("machine", "name"),
)
campaign_test = _table(
    "campaign_test",
    _of("campaign", "campaign"),
    _of("test", "test"),
    UniqueConstraint("campaign", "test"),
)
plan = _table(
    "plan",
    _of("machine", "machine"),
    Column("name", Text, nullable=False),
    Column("made_at", Instant, nullable=False),
    Column("due", Instant),
    Column("grace_days", Float, nullable=False, server_default="7"),
    Column("done_at", Instant),
    Column("document", Packed, nullable=False),
    UniqueConstraint("machine", "name"),
)
# what happened, and what counts as ordinary
event = _table(
    "event",
    _of("machine", "machine", optional=True),
    _of("instrument", "instrument", optional=True),
    Column("kind", Text, nullable=False),
    Column("at", Instant, nullable=False),
    Column("note", Text, nullable=False),
    Column("who", Text, nullable=False),
    Column("made_at", Instant, nullable=False),
    _one_of("kind", "repair", "parameter edit", "move", "crash", "calibration", "note"),
    Index(None, "machine", "at"),
)
baseline = _table(
    "baseline",
    _of("series", "series"),
    Column("tests", Document, nullable=False),  # keys of the tests
    Column("since", Instant, nullable=False),
    Column("set_at", Instant, nullable=False),
    Column("who", Text, nullable=False),
    Column("why", Text, nullable=False),
    Index(None, "series"),
)
tolerance = _table(
    "tolerance",
    _of("series", "series"),
    Column("indicator", Text, nullable=False),
    Column("lower", Float),
    Column("upper", Float),
    Column("relevance", Float),  # in place of the kind's
    Column("set_at", Instant, nullable=False),
    Column("who", Text, nullable=False),
    Column("why", Text, nullable=False),
    Index(None, "series"),
)
series_state = Table(
    "series_state",
    metadata,
    Column("series", Key, ForeignKey("series.id"), primary_key=True),
    Column("version", Key, nullable=False),  # grows with every change: of a page's ETag
    Column("state", Text, nullable=False),
    Column("since", Instant),
    Column("last_test", Instant),
    Column("due", Instant),
    Column("verdict", Packed, nullable=False),  # what the fleet's page needs: facts, strip
    Index(None, "state"),
)
# alarms
alarm = _table(
    "alarm",
    _of("series", "series", optional=True),
    _of("instrument", "instrument", optional=True),
    _of("held_by", "alarm", optional=True),  # the instrument's alarm that holds it back
    Column("opened_at", Instant, nullable=False),
    Index(None, "series"),
)
alarm_step = _table(
    "alarm_step",
    _of("alarm", "alarm"),
    Column("state", Text, nullable=False),
    Column("at", Instant, nullable=False),
    _of("test", "test", optional=True),
    Column("facts", Document, nullable=False),
    _text("who"),
    _text("why"),
    _one_of("state", "open", "worse", "held", "released", "acknowledged", "closed as repaired", "closed as false"),
    Index(None, "alarm"),
)
silence = _table(
    "silence",
    _of("machine", "machine"),
    Column("until", Instant, nullable=False),
    Column("at", Instant, nullable=False),
    Column("who", Text, nullable=False),
    Column("why", Text, nullable=False),
)
recipient = _table(
    "recipient",
    Column("channel", Text, nullable=False),  # a registered channel: log, mail, webhook
    Column("address", Text, nullable=False),
    Column("digest", Boolean, nullable=False),
    Column("active", Boolean, nullable=False),
    UniqueConstraint("channel", "address"),
)
outbox = _table(
    "outbox",
    _of("step", "alarm_step", optional=True),  # None: a digest
    _of("recipient", "recipient"),
    Column("made_at", Instant, nullable=False),
    Column("content", Document, nullable=False),
    Column("state", Text, nullable=False),
    Column("tries", Integer, nullable=False, server_default="0"),
    Column("next_at", Instant),
    Column("sent_at", Instant),
    _text("error"),
    UniqueConstraint("step", "recipient"),
    _one_of("state", "waiting", "sent", "given up"),
    Index(None, "state", "next_at"),
)
# who may come in through the pages
account = _table(
    "account",
    _of("person", "person"),
    Column("password", Text),  # as Argon2id keeps it; None: no password, tokens only
    Column("active", Boolean, nullable=False),
    Column("changed_at", Instant, nullable=False),
    UniqueConstraint("person"),
)
token = _table(
    "token",
    _of("person", "person"),
    Column("name", Text, nullable=False),
    Column("sha256", Text, nullable=False, unique=True),  # of the token, which is shown once
    Column("made_at", Instant, nullable=False),
    Column("ended_at", Instant),
)
session = _table(
    "session",
    _of("person", "person"),
    Column("sha256", Text, nullable=False, unique=True),  # of what the cookie holds
    Column("made_at", Instant, nullable=False),
    Column("seen_at", Instant, nullable=False),
    Column("ended_at", Instant),
)
# what takes long
job = _table(
    "job",
    Column("kind", Text, nullable=False),  # a registered kind
    Column("asked", Document, nullable=False),
    Column("state", Text, nullable=False),
    _text("who"),
    Column("made_at", Instant, nullable=False),
    Column("started_at", Instant),
    Column("beat_at", Instant),  # when its worker was alive last
    Column("ended_at", Instant),
    _text("worker"),
    Column("tries", Integer, nullable=False, server_default="0"),
    _text("step"),  # what it does now, in words
    Column("done", Integer, nullable=False, server_default="0"),
    Column("total", Integer, nullable=False, server_default="0"),
    Column("result", Packed),
    _text("error"),
    _one_of("state", "waiting", "running", "done", "failed", "cancelled"),
    Index(None, "state"),
)
drawing = _table(
    "drawing",
    _of("analysis", "analysis"),
    Column("software", Text, nullable=False),
    Column("made_at", Instant, nullable=False),
    Column("content", Packed, nullable=False),  # what the page of a test shows, drawn once; made anew at any time
    UniqueConstraint("analysis", "software"),
)
# who did what
audit = Table(
    "audit",
    metadata,
    Column("number", Key, primary_key=True, autoincrement=False),  # 1, 2, 3, ... without a gap
    Column("at", Instant, nullable=False),
    Column("who", Text, nullable=False),
    Column("what", Text, nullable=False),
    Column("subject", Text, nullable=False),
    Column("old", Document),
    Column("new", Document),
    _text("why"),
    Column("previous", Text, nullable=False),
    Column("sha256", Text, nullable=False, unique=True),
)
audit_head = Table(
    "audit_head",
    metadata,
    Column("id", Integer, primary_key=True, autoincrement=False),
    Column("number", Key, nullable=False),
    Column("sha256", Text, nullable=False),
    CheckConstraint("id = 1", name="only"),
)

FROZEN = (
    "blob", "test", "test_file", "set_aside", "analysis", "indicator", "calibration", "event", "baseline", "tolerance",
    "alarm_step", "silence", "audit",
)  # fmt: skip
"""Tables whose rows can neither be changed nor deleted."""
