"""The outbox and the acts of a person: each message once, with failures, crashes, two senders, clocks that go back."""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, timedelta
from pathlib import Path
from threading import Barrier
from typing import Any

import pytest
from sqlalchemy import select

from elastogeo.changes.alarms import OPEN, AlarmNews
from elastogeo.errors import DeliveryError, InputError
from elastogeo.history.alarms import delivery
from elastogeo.history.alarms.acts import acknowledge, close
from elastogeo.history.alarms.addresses import add_recipient, recipients, remove_recipient, shown
from elastogeo.history.alarms.channels import Message, channel
from elastogeo.history.alarms.channels.channel import _CHANNELS, Channel
from elastogeo.history.alarms.delivery import deliver, wait_after
from elastogeo.history.alarms.life import Step
from elastogeo.history.alarms.open_ones import rows_of, standing
from elastogeo.history.alarms.outbox import post
from elastogeo.history.alarms.rows import open_alarms, open_one, take
from elastogeo.history.alarms.silences import silence_machine, silent_until
from elastogeo.history.store import Store, audit, now, open_store, read, write
from elastogeo.history.store.schema import audit as trail
from elastogeo.history.store.schema import outbox
from elastogeo.history.store.schema import recipient as recipient_table
from tests.history.alarms.shop import DAY, START, add_log, key_of, make_series, make_test, messages, steps


class Box:
    """A channel that keeps what it is sent, and fails when it is told to."""

    def __init__(self) -> None:
        self.sent: list[Message] = []
        self.error: DeliveryError | None = None

    def send(self, message: Message, *_: object) -> None:
        if self.error is not None:
            raise self.error
        self.sent.append(message)


@pytest.fixture
def box(monkeypatch: pytest.MonkeyPatch) -> Box:
    channel("log")  # all that are there are registered before this one
    made = Box()
    monkeypatch.setitem(_CHANNELS, "box", Channel("box", lambda *_: None, made.send, "anywhere"))
    return made


def open_alarm_of(store: Store, series: int, ratio: float = 1.4, told: bool = True) -> int:
    """An alarm with its message, as a live test makes it."""
    with write(store) as connection:
        at = now()
        kept = take(connection, open_one(connection, at, series=series), [Step(OPEN, {"over": {"stiffness X": ratio}})], at)
        if told:
            (row,) = rows_of(connection, [kept], at)
            post(connection, kept, kept.keys[-1], AlarmNews(OPEN, row), at)
        return kept.key


def one(store: Store) -> Any:
    with read(store) as connection:
        return connection.execute(select(outbox)).one()


def test_a_message_is_sent_once_whatever_the_number_of_rounds(store: Store, box: Box, standing_clock: Any) -> None:
    to = add_log(store, "anywhere", by="box")
    open_alarm_of(store, make_series(store))
    for _ in range(3):
        deliver(store, {})
        standing_clock.advance(days=1)
    (message,) = box.sent
    assert message.subject == "Alarm: C50 no. 3, XY 200"
    assert "stiffness X 1.4 times its limit" in message.text
    assert message.document["alarm"]["state"] == "open"
    assert messages(store) == [("sent", message.subject, to)]
    assert message.key.endswith(f"-{to}")


def test_a_failure_is_tried_again_later_and_later_and_given_up_in_the_end(
    store: Store, box: Box, standing_clock: Any
) -> None:
    add_log(store, "anywhere", by="box")
    open_alarm_of(store, make_series(store))
    box.error = DeliveryError("the server is away")
    waits = []
    for tries in range(1, delivery.MOST_TRIES + 1):
        before = standing_clock.time
        found = deliver(store, {})
        assert [tried.error for tried in found.tried] == ["the server is away"]
        row = one(store)
        assert row.tries == tries
        if tries < delivery.MOST_TRIES:
            assert deliver(store, {}).tried == (), "not before its time"
            waits.append(row.next_at - before)
            standing_clock.time = row.next_at
    whole = [min(timedelta(minutes=2**k), timedelta(hours=8)) for k in range(delivery.MOST_TRIES - 1)]
    assert all(most / 2 <= wait <= most for wait, most in zip(waits, whole, strict=True))
    assert (row.state, row.error) == ("given up", "the server is away")
    (failed,) = standing_of(store).failed
    assert (failed.subject, failed.error) == ("Alarm: C50 no. 3, XY 200", "the server is away")


def standing_of(store: Store) -> Any:
    with read(store) as connection:
        return standing(connection, now())


def test_waits_scatter_between_senders() -> None:
    assert wait_after(3, lambda: 0.0) == timedelta(minutes=2)
    assert wait_after(3, lambda: 1.0) == timedelta(minutes=4)
    assert wait_after(200, lambda: 1.0) == delivery.LONGEST


def test_what_cannot_help_is_not_tried_again(store: Store, box: Box) -> None:
    add_log(store, "anywhere", by="box")
    open_alarm_of(store, make_series(store))
    box.error = DeliveryError("no such mailbox", lasting=True)
    deliver(store, {})
    assert (one(store).state, one(store).tries) == ("given up", 1)


def test_a_sender_that_dies_leaves_the_message_to_the_next_under_the_same_key(
    store: Store, box: Box, standing_clock: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    add_log(store, "anywhere", by="box")
    open_alarm_of(store, make_series(store))

    def dies(*_: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(delivery, "_noted", dies)
        with pytest.raises(KeyboardInterrupt):
            deliver(store, {})
    assert len(box.sent) == 1
    assert deliver(store, {}).tried == (), "its lease still runs"
    standing_clock.advance(minutes=16)
    deliver(store, {})
    assert len({message.key for message in box.sent}) == 1
    assert len(box.sent) == 2, "at least once, and known again by its key"
    assert one(store).state == "sent"


def test_two_senders_at_once_send_each_message_once(store: Store, url: str, box: Box) -> None:
    for number in range(3):
        add_log(store, f"anywhere {number}", by="box")
    open_alarm_of(store, make_series(store))
    open_alarm_of(store, make_series(store, "C50 no. 4"))
    start = Barrier(2)

    def sender(_: int) -> int:
        with open_store(url) as own:
            start.wait()
            return len(deliver(own, {}).tried)

    with ThreadPoolExecutor(2) as pool:
        counts = list(pool.map(sender, range(2)))
    assert sum(counts) == 6
    assert len({message.key for message in box.sent}) == len(box.sent) == 6


@pytest.mark.usefixtures("box")
def test_no_transaction_is_open_while_a_message_is_sent(store: Store, url: str, monkeypatch: pytest.MonkeyPatch) -> None:
    add_log(store, "anywhere", by="box")
    series = make_series(store)
    open_alarm_of(store, series)
    written = []

    def send(*_: object) -> None:
        with open_store(url) as other:
            written.append(make_test(other, series, START, {}))

    monkeypatch.setitem(_CHANNELS, "box", Channel("box", lambda *_: None, send, "anywhere"))
    deliver(store, {})
    assert len(written) == 1


def test_a_clock_that_goes_back_holds_no_message_for_long(store: Store, box: Box, standing_clock: Any) -> None:
    add_log(store, "anywhere", by="box")
    open_alarm_of(store, make_series(store))
    box.error = DeliveryError("the server is away")
    deliver(store, {})
    box.error = None
    standing_clock.advance(days=-400)
    deliver(store, {})
    assert [message.subject for message in box.sent] == ["Alarm: C50 no. 3, XY 200"]


# silence


def test_a_silence_holds_messages_and_its_end_lets_them_go(store: Store, box: Box, standing_clock: Any) -> None:
    add_log(store, "anywhere", by="box")
    quiet, other = make_series(store), make_series(store, "C50 no. 4")
    silence_machine(store, "C50 no. 3", standing_clock.time + 10 * DAY, "A. Miller", "taken apart")
    open_alarm_of(store, quiet)
    open_alarm_of(store, other)
    found = deliver(store, {})
    assert [message.subject for message in box.sent] == ["Alarm: C50 no. 4, XY 200"]
    assert (found.waiting, found.silenced) == (1, 1)
    standing_clock.advance(days=10, seconds=1)
    deliver(store, {})
    assert [message.subject for message in box.sent][1:] == ["Alarm: C50 no. 3, XY 200"]


def test_what_was_said_last_of_a_silence_counts(store: Store, box: Box, standing_clock: Any) -> None:
    add_log(store, "anywhere", by="box")
    series = make_series(store)
    silence_machine(store, "C50 no. 3", standing_clock.time + 10 * DAY, "A. Miller", "taken apart")
    silence_machine(store, "C50 no. 3", None, "A. Miller", "runs again")
    open_alarm_of(store, series)
    deliver(store, {})
    assert len(box.sent) == 1


def test_the_trail_calls_a_silent_machine_by_its_key(store: Store, standing_clock: Any) -> None:
    make_series(store, "C50 no. 4")
    make_series(store)
    silence_machine(store, "C50 no. 3", standing_clock.time + DAY, "A. Miller", "taken apart")
    with read(store) as connection:
        assert connection.scalars(select(trail.c.subject).where(trail.c.what == "silence")).all() == ["machine 2"]


def test_a_silence_needs_a_machine_a_reason_and_a_zone(store: Store) -> None:
    make_series(store)
    with pytest.raises(InputError, match=r"no machine 'C51'; there are: C50 no. 3"):
        silence_machine(store, "C51", START, "A. Miller", "why not")
    with pytest.raises(InputError, match="needs a reason"):
        silence_machine(store, "C50 no. 3", START, "A. Miller", " ")
    with pytest.raises(InputError, match="has no time zone"):
        silence_machine(store, "C50 no. 3", START.replace(tzinfo=None), "A. Miller", "why not")


def test_a_silence_until_a_day_that_is_past_is_refused(store: Store, standing_clock: Any) -> None:
    """Whoever mistypes the year must not think that the machine is silent, nor end a silence by it."""
    make_series(store)
    silence_machine(store, "C50 no. 3", standing_clock.time + 10 * DAY, "A. Miller", "taken apart")
    for past in (standing_clock.time, standing_clock.time - 365 * DAY):
        with pytest.raises(InputError, match=rf"{past:%Y-%m-%d %H:%M} UTC is past; give a day to come, or now"):
            silence_machine(store, "C50 no. 3", past, "A. Miller", "taken apart")
    with read(store) as connection:
        assert list(silent_until(connection, standing_clock.time).values()) == [standing_clock.time + 10 * DAY]


# acknowledge, close


def test_acknowledge_needs_a_reason_and_stays_with_its_person(store: Store) -> None:
    number = open_alarm_of(store, make_series(store))
    with pytest.raises(InputError, match="say why you acknowledge"):
        acknowledge(store, number, "A. Miller", "  ")
    for _ in range(2):
        (row,) = acknowledge(store, number, "A. Miller", "nut is ordered").alarms
    assert (row.state, row.who, row.why) == ("acknowledged", "A. Miller", "nut is ordered")
    assert steps(store) == [(number, "open"), (number, "acknowledged")]
    with read(store) as connection:
        last = connection.execute(select(trail).order_by(trail.c.number.desc()).limit(1)).one()
        assert (last.who, last.subject, last.new, last.why) == (
            "A. Miller",
            f"alarm {number}",
            "acknowledged",
            "nut is ordered",
        )
        assert audit.verify(connection) == ()


def test_the_end_is_told_to_whoever_was_told_of_the_beginning(store: Store, box: Box) -> None:
    add_log(store, "first", by="box")
    number = open_alarm_of(store, make_series(store))
    deliver(store, {})
    add_log(store, "second", by="box")
    close(store, number, True, "A. Miller", "nut replaced")
    deliver(store, {})
    assert [message.subject.split(":")[0] for message in box.sent] == ["Alarm", "Alarm closed as repaired"]
    assert "A. Miller closed the alarm of C50 no. 3, XY 200 as repaired: nut replaced." in box.sent[1].text
    assert "new baseline" in box.sent[1].text
    with pytest.raises(InputError, match=rf"alarm {number} was closed as repaired by A\. Miller: nut replaced"):
        close(store, number, False, "A. Miller", "again")
    with pytest.raises(InputError, match=rf"alarm {number} was closed"):
        acknowledge(store, number, "A. Miller", "again")


def test_an_alarm_that_is_closed_before_it_was_told_is_told_to_nobody(store: Store, box: Box) -> None:
    add_log(store, "first", by="box")
    number = open_alarm_of(store, make_series(store))
    close(store, number, False, "A. Miller", "ball")
    found = deliver(store, {})
    assert (box.sent, found.waiting) == ([], 0)
    assert [state for state, *_ in messages(store)] == ["given up"]


def test_an_alarm_that_may_have_been_told_is_told_to_be_closed(store: Store, box: Box) -> None:
    """A try whose end nobody knows: the sender died after the claim."""
    add_log(store, "first", by="box")
    number = open_alarm_of(store, make_series(store))
    delivery._claim(store, set())
    close(store, number, False, "A. Miller", "ball")
    deliver(store, {})
    assert [message.subject.split(":")[0] for message in box.sent] == ["Alarm closed as false"]


def test_there_is_no_alarm_of_that_number(store: Store) -> None:
    with pytest.raises(InputError, match="there is no alarm 7"):
        close(store, 7, False, "A. Miller", "ball")


# recipients


def test_recipients_are_entered_once_and_removed(store: Store, box: Box) -> None:
    for _ in range(2):
        found = add_recipient(store, "box", "first", "A. Miller")
    assert [(one.channel, one.address, one.digest, one.active) for one in found.recipients] == [("box", "first", True, True)]
    open_alarm_of(store, make_series(store))
    assert recipients(store).recipients[0].waiting == 1
    remove_recipient(store, "box", "first", "A. Miller")
    deliver(store, {})
    assert box.sent == []
    assert recipients(store).recipients[0].waiting == 0
    with pytest.raises(InputError, match="nobody is told by box at 'first'"):
        remove_recipient(store, "box", "first", "A. Miller")
    assert add_recipient(store, "box", "first", "A. Miller", digest=False).recipients[0].active
    with pytest.raises(InputError, match="no mail address"):
        add_recipient(store, "mail", "A. Miller <a@example.com>", "A. Miller")


def test_the_audit_trail_keeps_no_secret_of_a_web_address(store: Store) -> None:
    add_recipient(store, "webhook", "https://hooks.example.com/T00/s3cret", "A. Miller", settings={})
    with read(store) as connection:
        kept = json.dumps([list(map(str, row)) for row in connection.execute(select(trail))])
    assert "hooks.example.com/..." in kept
    assert "s3cret" not in kept
    assert shown("name@example.com") == "name@example.com"


def test_the_digest_keeps_no_secret_of_a_web_address(store: Store, box: Box) -> None:
    add_log(store, "https://hooks.example.com/T00/s3cret", by="box")
    open_alarm_of(store, make_series(store))
    box.error = DeliveryError("no such hook", lasting=True)
    deliver(store, {})
    (failed,) = standing_of(store).failed
    assert failed.address == "https://hooks.example.com/..."


def test_a_channel_that_is_gone_is_no_reason_to_stop(store: Store, box: Box) -> None:
    with write(store) as connection:
        key_of(connection, recipient_table, channel="pigeon", address="loft", digest=False, active=True)
    add_log(store, "first", by="box")
    open_alarm_of(store, make_series(store))
    deliver(store, {})
    assert len(box.sent) == 1
    assert sorted(state for state, *_ in messages(store)) == ["given up", "sent"]


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_fault_of_a_channel_is_a_try_that_failed_and_shows_no_text(
    store: Store, box: Box, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object) -> None:
        raise UnicodeError("label of s3cret empty or too long")

    monkeypatch.setitem(_CHANNELS, "broken", Channel("broken", lambda *_: None, broken, "anywhere"))
    add_log(store, "first", by="broken")
    add_log(store, "second", by="box")
    open_alarm_of(store, make_series(store))
    tried = deliver(store, {}).tried
    assert len(box.sent) == 1
    assert [one.error for one in tried if one.channel == "broken"] == [
        "broken: UnicodeError; correct its address or settings"
    ]
    assert sorted(state for state, *_ in messages(store)) == ["sent", "waiting"]


# digest


def test_one_digest_a_week_whatever_the_number_of_calls(store: Store, box: Box, standing_clock: Any) -> None:
    add_log(store, "weekly", digest=True, by="box")
    add_log(store, "never", by="box")
    series = make_series(store, interval=28.0)
    make_test(store, series, START - 60 * DAY, {})
    open_alarm_of(store, series, told=False)
    for hours in range(0, 24 * 15, 5):  # two Mondays to come
        standing_clock.time = START + timedelta(hours=hours)
        deliver(store, {})
    assert len(box.sent) == 3
    assert len({message.key for message in box.sent}) == 3
    first = box.sent[0]
    assert first.subject == "Alarms: 2 March 2026"
    assert "1 alarm is open" in first.text
    assert "stiffness X 1.4 times its limit" in first.text


def test_a_clock_that_goes_back_sends_no_week_twice(store: Store, box: Box, standing_clock: Any) -> None:
    add_log(store, "weekly", digest=True, by="box")
    for days in (0, 7, 0, 1, 7, 8):
        standing_clock.time = START + days * DAY
        deliver(store, {})
    assert len(box.sent) == 2
    assert "No alarm is open, no test is overdue." in box.sent[0].text


def test_a_new_digest_takes_the_place_of_one_that_could_not_be_sent(store: Store, box: Box, standing_clock: Any) -> None:
    add_log(store, "weekly", digest=True, by="box")
    box.error = DeliveryError("away")
    deliver(store, {})
    standing_clock.advance(days=7)
    box.error = None
    deliver(store, {})
    assert [message.subject for message in box.sent] == ["Alarms: 9 March 2026"]
    assert standing_of(store).failed == ()


def test_the_log_keeps_the_message(store: Store, tmp_path: Path) -> None:
    add_log(store, str(tmp_path / "alarms.jsonl"))
    open_alarm_of(store, make_series(store))
    deliver(store, {})
    (line,) = (tmp_path / "alarms.jsonl").read_text(encoding="ascii").splitlines()
    assert json.loads(line)["content"]["schema"] == "elastogeo.alarm/1"


def test_open_alarms_are_those_that_no_person_closed(store: Store) -> None:
    first = open_alarm_of(store, make_series(store))
    second = open_alarm_of(store, make_series(store, "C50 no. 4"))
    close(store, first, False, "A. Miller", "ball")
    with read(store) as connection:
        assert [kept.key for kept in open_alarms(connection)] == [second]
    assert START.tzinfo is UTC
