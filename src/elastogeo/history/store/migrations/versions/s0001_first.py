"""The first schema."""

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None

KEY = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
INSTANT = sa.BigInteger()


def upgrade() -> None:
    """Make the tables."""
    _who_and_what()
    _what_was_measured()
    _what_it_says()
    _sets_of_tests()
    _what_is_ordinary()
    _alarms()
    _messages()
    _who_did_what()


def _who_and_what() -> None:
    op.create_table(
        "person",
        sa.Column("id", KEY, nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("role", sa.Text(), nullable=False),
        sa.Column("email", sa.Text(), server_default="", nullable=False),
        sa.Column("made_at", INSTANT, nullable=False),
        sa.CheckConstraint("role IN ('reader', 'engineer', 'administrator')", name=op.f("ck_person_role")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_person")),
        sa.UniqueConstraint("name", name=op.f("uq_person_name")),
    )
    op.create_table(
        "machine",
        sa.Column("id", KEY, nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("kind", sa.Text(), server_default="", nullable=False),
        sa.Column("serial", sa.Text(), server_default="", nullable=False),
        sa.Column("place", sa.Text(), server_default="", nullable=False),
        sa.Column("made_at", INSTANT, nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_machine")),
        sa.UniqueConstraint("name", name=op.f("uq_machine_name")),
    )
    op.create_table(
        "instrument",
        sa.Column("id", KEY, nullable=False),
        sa.Column("serial", sa.Text(), nullable=False),
        sa.Column("kind", sa.Text(), server_default="", nullable=False),
        sa.Column("made_at", INSTANT, nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_instrument")),
        sa.UniqueConstraint("serial", name=op.f("uq_instrument_serial")),
    )
    op.create_table(
        "calibration",
        sa.Column("id", KEY, nullable=False),
        sa.Column("instrument", KEY, nullable=False),
        sa.Column("at", INSTANT, nullable=False),
        sa.Column("due", INSTANT, nullable=True),
        sa.Column("certificate", sa.Text(), server_default="", nullable=False),
        sa.Column("content", sa.Text(), nullable=False),
        sa.Column("who", sa.Text(), server_default="", nullable=False),
        sa.ForeignKeyConstraint(["instrument"], ["instrument.id"], name=op.f("fk_calibration_instrument_instrument")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_calibration")),
    )


def _what_was_measured() -> None:
    op.create_table(
        "blob",
        sa.Column("sha256", sa.Text(), nullable=False),
        sa.Column("size", KEY, nullable=False),
        sa.Column("made_at", INSTANT, nullable=False),
        sa.PrimaryKeyConstraint("sha256", name=op.f("pk_blob")),
    )
    op.create_table(
        "series",
        sa.Column("id", KEY, nullable=False),
        sa.Column("machine", KEY, nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("recipe", sa.Text(), nullable=False),
        sa.Column("recipe_sha256", sa.Text(), nullable=False),
        sa.Column("software", sa.Text(), nullable=False),
        sa.Column("interval_days", sa.Float(), nullable=True),
        sa.Column("grace_days", sa.Float(), server_default="7", nullable=False),
        sa.Column("alpha", sa.Float(), server_default="0.005", nullable=False),
        sa.ForeignKeyConstraint(["machine"], ["machine.id"], name=op.f("fk_series_machine_machine")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_series")),
        sa.UniqueConstraint("machine", "name", name=op.f("uq_series_machine_name")),
        sa.UniqueConstraint("machine", "recipe_sha256", name=op.f("uq_series_machine_recipe_sha256")),
    )
    op.create_table(
        "test",
        sa.Column("id", KEY, nullable=False),
        sa.Column("series", KEY, nullable=False),
        sa.Column("sha256", sa.Text(), nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("at", INSTANT, nullable=False),
        sa.Column("zone", sa.Text(), server_default="", nullable=False),
        sa.Column("imported_at", INSTANT, nullable=False),
        sa.Column("origin", sa.Text(), nullable=False),
        sa.Column("from_what", sa.Text(), server_default="", nullable=False),
        sa.Column("temperature", sa.Float(), nullable=True),
        sa.Column("instrument", KEY, nullable=True),
        sa.Column("repeats", KEY, nullable=True),
        sa.Column("who", sa.Text(), server_default="", nullable=False),
        sa.Column("about", sa.Text(), nullable=False),
        sa.CheckConstraint("origin IN ('measured', 'simulated', 'reconstructed')", name=op.f("ck_test_origin")),
        sa.ForeignKeyConstraint(["instrument"], ["instrument.id"], name=op.f("fk_test_instrument_instrument")),
        sa.ForeignKeyConstraint(["repeats"], ["test.id"], name=op.f("fk_test_repeats_test")),
        sa.ForeignKeyConstraint(["series"], ["series.id"], name=op.f("fk_test_series_series")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_test")),
        sa.UniqueConstraint("sha256", name=op.f("uq_test_sha256")),
    )
    op.create_index(op.f("ix_test_series_at"), "test", ["series", "at"])
    op.create_table(
        "test_file",
        sa.Column("id", KEY, nullable=False),
        sa.Column("test", KEY, nullable=False),
        sa.Column("path", sa.Text(), nullable=False),
        sa.Column("sha256", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["sha256"], ["blob.sha256"], name=op.f("fk_test_file_sha256_blob")),
        sa.ForeignKeyConstraint(["test"], ["test.id"], name=op.f("fk_test_file_test_test")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_test_file")),
        sa.UniqueConstraint("test", "path", name=op.f("uq_test_file_test_path")),
    )
    op.create_table(
        "set_aside",
        sa.Column("id", KEY, nullable=False),
        sa.Column("test", KEY, nullable=False),
        sa.Column("aside", sa.Boolean(), nullable=False),
        sa.Column("at", INSTANT, nullable=False),
        sa.Column("who", sa.Text(), nullable=False),
        sa.Column("why", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["test"], ["test.id"], name=op.f("fk_set_aside_test_test")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_set_aside")),
    )
    op.create_index(op.f("ix_set_aside_test"), "set_aside", ["test"])


def _what_it_says() -> None:
    op.create_table(
        "analysis",
        sa.Column("id", KEY, nullable=False),
        sa.Column("test", KEY, nullable=False),
        sa.Column("software", sa.Text(), nullable=False),
        sa.Column("settings", sa.Text(), nullable=False),
        sa.Column("inputs_sha256", sa.Text(), nullable=False),
        sa.Column("made_at", INSTANT, nullable=False),
        sa.Column("supported", sa.Boolean(), nullable=False),
        sa.Column("error", sa.Text(), nullable=True),
        sa.Column("signatures", sa.LargeBinary(), nullable=True),
        sa.Column("document_sha256", sa.Text(), nullable=True),
        sa.Column("document", sa.LargeBinary(), nullable=True),
        sa.ForeignKeyConstraint(["test"], ["test.id"], name=op.f("fk_analysis_test_test")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_analysis")),
        sa.UniqueConstraint("test", "software", "inputs_sha256", name=op.f("uq_analysis_test_software_inputs_sha256")),
    )
    op.create_table(
        "indicator",
        sa.Column("id", KEY, nullable=False),
        sa.Column("analysis", KEY, nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("kind", sa.Text(), nullable=False),
        sa.Column("value", sa.Float(), nullable=False),
        sa.Column("standard_uncertainty", sa.Float(), nullable=True),
        sa.ForeignKeyConstraint(["analysis"], ["analysis.id"], name=op.f("fk_indicator_analysis_analysis")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_indicator")),
        sa.UniqueConstraint("analysis", "name", name=op.f("uq_indicator_analysis_name")),
    )


def _sets_of_tests() -> None:
    op.create_table(
        "campaign",
        sa.Column("id", KEY, nullable=False),
        sa.Column("machine", KEY, nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("made_at", INSTANT, nullable=False),
        sa.Column("content", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["machine"], ["machine.id"], name=op.f("fk_campaign_machine_machine")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_campaign")),
        sa.UniqueConstraint("machine", "name", name=op.f("uq_campaign_machine_name")),
    )
    op.create_table(
        "campaign_test",
        sa.Column("id", KEY, nullable=False),
        sa.Column("campaign", KEY, nullable=False),
        sa.Column("test", KEY, nullable=False),
        sa.ForeignKeyConstraint(["campaign"], ["campaign.id"], name=op.f("fk_campaign_test_campaign_campaign")),
        sa.ForeignKeyConstraint(["test"], ["test.id"], name=op.f("fk_campaign_test_test_test")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_campaign_test")),
        sa.UniqueConstraint("campaign", "test", name=op.f("uq_campaign_test_campaign_test")),
    )
    op.create_table(
        "plan",
        sa.Column("id", KEY, nullable=False),
        sa.Column("machine", KEY, nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("made_at", INSTANT, nullable=False),
        sa.Column("due", INSTANT, nullable=True),
        sa.Column("grace_days", sa.Float(), server_default="7", nullable=False),
        sa.Column("done_at", INSTANT, nullable=True),
        sa.Column("document", sa.LargeBinary(), nullable=False),
        sa.ForeignKeyConstraint(["machine"], ["machine.id"], name=op.f("fk_plan_machine_machine")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_plan")),
        sa.UniqueConstraint("machine", "name", name=op.f("uq_plan_machine_name")),
    )


def _what_is_ordinary() -> None:
    op.create_table(
        "event",
        sa.Column("id", KEY, nullable=False),
        sa.Column("machine", KEY, nullable=True),
        sa.Column("instrument", KEY, nullable=True),
        sa.Column("kind", sa.Text(), nullable=False),
        sa.Column("at", INSTANT, nullable=False),
        sa.Column("note", sa.Text(), nullable=False),
        sa.Column("who", sa.Text(), nullable=False),
        sa.Column("made_at", INSTANT, nullable=False),
        sa.CheckConstraint(
            "kind IN ('repair', 'parameter edit', 'move', 'crash', 'calibration', 'note')", name=op.f("ck_event_kind")
        ),
        sa.ForeignKeyConstraint(["instrument"], ["instrument.id"], name=op.f("fk_event_instrument_instrument")),
        sa.ForeignKeyConstraint(["machine"], ["machine.id"], name=op.f("fk_event_machine_machine")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_event")),
    )
    op.create_index(op.f("ix_event_machine_at"), "event", ["machine", "at"])
    op.create_table(
        "baseline",
        sa.Column("id", KEY, nullable=False),
        sa.Column("series", KEY, nullable=False),
        sa.Column("tests", sa.Text(), nullable=False),
        sa.Column("since", INSTANT, nullable=False),
        sa.Column("set_at", INSTANT, nullable=False),
        sa.Column("who", sa.Text(), nullable=False),
        sa.Column("why", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["series"], ["series.id"], name=op.f("fk_baseline_series_series")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_baseline")),
    )
    op.create_index(op.f("ix_baseline_series"), "baseline", ["series"])
    op.create_table(
        "tolerance",
        sa.Column("id", KEY, nullable=False),
        sa.Column("series", KEY, nullable=False),
        sa.Column("indicator", sa.Text(), nullable=False),
        sa.Column("lower", sa.Float(), nullable=True),
        sa.Column("upper", sa.Float(), nullable=True),
        sa.Column("relevance", sa.Float(), nullable=True),
        sa.Column("set_at", INSTANT, nullable=False),
        sa.Column("who", sa.Text(), nullable=False),
        sa.Column("why", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["series"], ["series.id"], name=op.f("fk_tolerance_series_series")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_tolerance")),
    )
    op.create_index(op.f("ix_tolerance_series"), "tolerance", ["series"])
    op.create_table(
        "series_state",
        sa.Column("series", KEY, nullable=False),
        sa.Column("version", KEY, nullable=False),
        sa.Column("state", sa.Text(), nullable=False),
        sa.Column("since", INSTANT, nullable=True),
        sa.Column("last_test", INSTANT, nullable=True),
        sa.Column("due", INSTANT, nullable=True),
        sa.Column("verdict", sa.LargeBinary(), nullable=False),
        sa.ForeignKeyConstraint(["series"], ["series.id"], name=op.f("fk_series_state_series_series")),
        sa.PrimaryKeyConstraint("series", name=op.f("pk_series_state")),
    )
    op.create_index(op.f("ix_series_state_state"), "series_state", ["state"])


def _alarms() -> None:
    op.create_table(
        "alarm",
        sa.Column("id", KEY, nullable=False),
        sa.Column("series", KEY, nullable=True),
        sa.Column("instrument", KEY, nullable=True),
        sa.Column("held_by", KEY, nullable=True),
        sa.Column("opened_at", INSTANT, nullable=False),
        sa.ForeignKeyConstraint(["held_by"], ["alarm.id"], name=op.f("fk_alarm_held_by_alarm")),
        sa.ForeignKeyConstraint(["instrument"], ["instrument.id"], name=op.f("fk_alarm_instrument_instrument")),
        sa.ForeignKeyConstraint(["series"], ["series.id"], name=op.f("fk_alarm_series_series")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_alarm")),
    )
    op.create_index(op.f("ix_alarm_series"), "alarm", ["series"])
    op.create_table(
        "alarm_step",
        sa.Column("id", KEY, nullable=False),
        sa.Column("alarm", KEY, nullable=False),
        sa.Column("state", sa.Text(), nullable=False),
        sa.Column("at", INSTANT, nullable=False),
        sa.Column("test", KEY, nullable=True),
        sa.Column("facts", sa.Text(), nullable=False),
        sa.Column("who", sa.Text(), server_default="", nullable=False),
        sa.Column("why", sa.Text(), server_default="", nullable=False),
        sa.CheckConstraint(
            "state IN ('open', 'worse', 'held', 'released', 'acknowledged', 'closed as repaired', 'closed as false')",
            name=op.f("ck_alarm_step_state"),
        ),
        sa.ForeignKeyConstraint(["alarm"], ["alarm.id"], name=op.f("fk_alarm_step_alarm_alarm")),
        sa.ForeignKeyConstraint(["test"], ["test.id"], name=op.f("fk_alarm_step_test_test")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_alarm_step")),
    )
    op.create_index(op.f("ix_alarm_step_alarm"), "alarm_step", ["alarm"])
    op.create_table(
        "silence",
        sa.Column("id", KEY, nullable=False),
        sa.Column("machine", KEY, nullable=False),
        sa.Column("until", INSTANT, nullable=False),
        sa.Column("at", INSTANT, nullable=False),
        sa.Column("who", sa.Text(), nullable=False),
        sa.Column("why", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["machine"], ["machine.id"], name=op.f("fk_silence_machine_machine")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_silence")),
    )


def _messages() -> None:
    op.create_table(
        "recipient",
        sa.Column("id", KEY, nullable=False),
        sa.Column("channel", sa.Text(), nullable=False),
        sa.Column("address", sa.Text(), nullable=False),
        sa.Column("digest", sa.Boolean(), nullable=False),
        sa.Column("active", sa.Boolean(), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_recipient")),
        sa.UniqueConstraint("channel", "address", name=op.f("uq_recipient_channel_address")),
    )
    op.create_table(
        "outbox",
        sa.Column("id", KEY, nullable=False),
        sa.Column("step", KEY, nullable=True),
        sa.Column("recipient", KEY, nullable=False),
        sa.Column("made_at", INSTANT, nullable=False),
        sa.Column("content", sa.Text(), nullable=False),
        sa.Column("state", sa.Text(), nullable=False),
        sa.Column("tries", sa.Integer(), server_default="0", nullable=False),
        sa.Column("next_at", INSTANT, nullable=True),
        sa.Column("sent_at", INSTANT, nullable=True),
        sa.Column("error", sa.Text(), server_default="", nullable=False),
        sa.CheckConstraint("state IN ('waiting', 'sent', 'given up')", name=op.f("ck_outbox_state")),
        sa.ForeignKeyConstraint(["recipient"], ["recipient.id"], name=op.f("fk_outbox_recipient_recipient")),
        sa.ForeignKeyConstraint(["step"], ["alarm_step.id"], name=op.f("fk_outbox_step_alarm_step")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_outbox")),
        sa.UniqueConstraint("step", "recipient", name=op.f("uq_outbox_step_recipient")),
    )
    op.create_index(op.f("ix_outbox_state_next_at"), "outbox", ["state", "next_at"])


def _who_did_what() -> None:
    op.create_table(
        "audit",
        sa.Column("number", KEY, autoincrement=False, nullable=False),
        sa.Column("at", INSTANT, nullable=False),
        sa.Column("who", sa.Text(), nullable=False),
        sa.Column("what", sa.Text(), nullable=False),
        sa.Column("subject", sa.Text(), nullable=False),
        sa.Column("old", sa.Text(), nullable=True),
        sa.Column("new", sa.Text(), nullable=True),
        sa.Column("why", sa.Text(), server_default="", nullable=False),
        sa.Column("previous", sa.Text(), nullable=False),
        sa.Column("sha256", sa.Text(), nullable=False),
        sa.PrimaryKeyConstraint("number", name=op.f("pk_audit")),
        sa.UniqueConstraint("sha256", name=op.f("uq_audit_sha256")),
    )
    op.create_table(
        "audit_head",
        sa.Column("id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("number", KEY, nullable=False),
        sa.Column("sha256", sa.Text(), nullable=False),
        sa.CheckConstraint("id = 1", name=op.f("ck_audit_head_only")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_audit_head")),
    )
