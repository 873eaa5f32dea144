"""Channels: what they hand on, what they refuse, and what never shows in an error."""

from __future__ import annotations

import email
import email.policy
import json
import logging
import socket
import sys
from pathlib import Path
from typing import Any

import pytest

from elastogeo.errors import DeliveryError, InputError, SelectionError
from elastogeo.history.alarms.channels import Channel, Message, channel, channels, webhook
from tests.history.alarms.servers import certificate, mail_server, web_server

MESSAGE = Message("k-17", "Alarm: Hermle C50 no. 3", "11 % softer in X.\nSince 11 June.", {"alarm": 17})


@pytest.fixture(scope="module")
def pem(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return certificate(tmp_path_factory.mktemp("certificate"))


def mail_settings(server: Any, **more: str) -> dict[str, str]:
    host, port = "localhost", str(server.server_address[1])
    given = {"HOST": host, "PORT": port, "FROM": "elastogeo@example.com", "SECURITY": "none"} | more
    return {f"ELASTOGEO_SMTP_{name}": value for name, value in given.items()}


# the contract


@pytest.mark.parametrize("made", channels(), ids=lambda made: made.name)
def test_a_channel_takes_its_sample_and_refuses_what_is_no_address(made: Channel) -> None:
    made.check(made.sample, {})
    for wrong in ("", " ", "no address", "a\r\nBcc: b@example.com", "\0"):
        with pytest.raises(InputError, match=r"give|name"):
            made.check(wrong, {})


@pytest.mark.parametrize(
    ("name", "address"),
    [
        ("mail", ".anna@example.com"), ("mail", "anna.@example.com"), ("mail", "an..na@example.com"), ("mail", "a@b-.de"),
        ("mail", "anna@192.0.2.4"), ("mail", "anna@example.123"), ("mail", "anna@example.com.", ), ("mail", "a@b.de,c@d.de"),
        ("webhook", "https://localhost/alarms"), ("webhook", "https://127.0.0.1/"), ("webhook", "https://[::1]/"),
        ("webhook", "https://10.0.0.3/x"), ("webhook", "https://256.256.256.256/"), ("webhook", "https://-a.de/"),
        ("webhook", "https://0x7f.1/"), ("webhook", "https://a..example.com/"),
        ("log", "/tmp/"), ("log", "/tmp/a\n"), ("log", "/dev/full"), ("log", f"/tmp/{'x' * 300}"),
    ],
)  # fmt: skip
def test_who_can_never_be_told_is_refused_when_he_is_entered(name: str, address: str) -> None:
    with pytest.raises(InputError, match=r"give|name|correct"):
        channel(name).check(address, {})


@pytest.mark.parametrize("address", ["o'hara+alarms@mail.example.co.uk", "root@printer", "a_b@x--y.example"])
def test_unusual_mail_addresses_are_taken(address: str) -> None:
    channel("mail").check(address, {})


def test_a_server_in_the_house_is_taken_where_the_environment_allows_it() -> None:
    for address in ("http://10.0.0.3/x", "https://localhost:8443/x", "https://[fd00::1]/x"):
        channel("webhook").check(address, {"ELASTOGEO_WEBHOOK_PRIVATE": "yes"})


def test_the_recipe_is_complete(tmp_path: Path) -> None:
    recipe = (
        str(sys.modules[channel.__module__].__doc__).split("`channels/toy.py`::\n")[1].split("\nWhat the contract asks")[0]
    )
    code = "\n".join(line.removeprefix("    ") for line in recipe.splitlines())
    registry = channel.__globals__["_CHANNELS"]
    before = dict(registry)
    try:
        exec(compile(code, "toy.py", "exec"), {"__name__": "toy"})
        added = {name: made for name, made in registry.items() if name not in before}
        added["toy"].check(str(tmp_path), {})
        added["toy"].send(MESSAGE, str(tmp_path), {})
        with pytest.raises(DeliveryError, match=r"missing"):
            added["toy"].send(MESSAGE, str(tmp_path / "missing"), {})
    finally:
        registry.clear()
        registry.update(before)
    assert (tmp_path / "k-17.txt").read_text(encoding="utf-8") == MESSAGE.text


def test_an_unknown_channel_is_refused_by_name() -> None:
    with pytest.raises(SelectionError, match=r"no channel 'pigeon'; there are log, mail, webhook"):
        channel("pigeon")


# log


def test_the_log_is_a_line_a_message(tmp_path: Path) -> None:
    path = tmp_path / "alarms.jsonl"
    for _ in range(2):
        channel("log").send(MESSAGE, str(path), {})
    lines = [json.loads(line) for line in path.read_text(encoding="ascii").splitlines()]
    assert [line["key"] for line in lines] == ["k-17", "k-17"]
    assert lines[0]["text"] == MESSAGE.text
    with pytest.raises(DeliveryError, match=r"No such file"):
        channel("log").send(MESSAGE, str(tmp_path / "gone" / "alarms.jsonl"), {})


def test_the_log_of_the_program(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING, logger="elastogeo.alarms"):
        channel("log").send(MESSAGE, "logging", {})
    assert json.loads(caplog.records[0].getMessage())["content"] == {"alarm": 17}


# mail


def test_a_letter_arrives_once_with_its_key() -> None:
    with mail_server() as server:
        channel("mail").send(MESSAGE, "maintenance@example.com", mail_settings(server))
    (raw,) = server.letters
    letter = email.message_from_bytes(raw, policy=email.policy.default)
    assert letter["Subject"] == MESSAGE.subject
    assert letter["To"] == "maintenance@example.com"
    assert letter["Message-ID"] == "<k-17@example.com>"
    assert letter["Auto-Submitted"] == "auto-generated"
    assert letter.get_content().splitlines() == MESSAGE.text.splitlines()


def test_a_machine_whose_name_breaks_the_line_adds_no_header() -> None:
    named = Message("k", "Alarm: C50\r\nBcc: spy@example.com\n\nX\u2028Y", "text", {})
    with mail_server() as server:
        channel("mail").send(named, "maintenance@example.com", mail_settings(server))
    letter = email.message_from_bytes(server.letters[0], policy=email.policy.default)
    assert letter["Subject"] == "Alarm: C50 Bcc: spy@example.com X Y"
    assert letter["Bcc"] is None
    assert [rest for word, rest, _ in server.said if word == "RCPT"] == ["TO:<maintenance@example.com>"]


def test_an_address_that_breaks_the_line_is_not_sent_to() -> None:
    with mail_server() as server, pytest.raises(DeliveryError, match=r"is no mail address") as refused:
        channel("mail").send(MESSAGE, "a@example.com\r\nRCPT TO:<b@example.com>", mail_settings(server))
    assert refused.value.lasting
    assert server.said == []


def test_the_password_goes_over_tls_only(pem: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SSL_CERT_FILE", str(pem))
    secret = {"USER": "elastogeo", "PASSWORD": "hunter2"}
    with mail_server(pem) as server:
        channel("mail").send(MESSAGE, "a@example.com", mail_settings(server, SECURITY="starttls", **secret))
        assert [secure for word, _, secure in server.said if word == "AUTH"] == [True]
        assert len(server.letters) == 1
        with pytest.raises(DeliveryError, match=r"not sent over a line that is not encrypted"):
            channel("mail").send(MESSAGE, "a@example.com", mail_settings(server, **secret))
    with mail_server() as plain, pytest.raises(DeliveryError, match=r"STARTTLS"):
        channel("mail").send(MESSAGE, "a@example.com", mail_settings(plain, SECURITY="starttls", **secret))
    assert [word for word, *_ in plain.said if word == "AUTH"] == []


def test_a_certificate_that_nobody_vouches_for_is_refused(pem: Path) -> None:
    with mail_server(pem) as server, pytest.raises(DeliveryError, match=r"(?i)certificate"):
        channel("mail").send(MESSAGE, "a@example.com", mail_settings(server, SECURITY="starttls"))
    assert server.letters == []


def test_no_error_shows_the_password(pem: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SSL_CERT_FILE", str(pem))
    settings_of = {"USER": "elastogeo", "PASSWORD": "hunter2", "SECURITY": "starttls"}
    with mail_server(pem, password=False) as server, pytest.raises(DeliveryError, match=r"password \(535\)") as refused:
        channel("mail").send(MESSAGE, "a@example.com", mail_settings(server, **settings_of))
    assert "hunter2" not in str(refused.value)
    assert "aHVudGVyMg" not in str(refused.value)


@pytest.mark.parametrize(("code", "lasting"), [(550, True), (451, False)])
def test_a_refused_recipient_is_given_up_only_if_the_server_says_so_for_good(code: int, lasting: bool) -> None:
    with mail_server(refuse=code) as server, pytest.raises(DeliveryError, match=f"refused a@example.com: {code}") as refused:
        channel("mail").send(MESSAGE, "a@example.com", mail_settings(server))
    assert refused.value.lasting is lasting


@pytest.mark.parametrize("address", ["name@example..com", f"name@{'a' * 64}.com"])
def test_a_mail_address_of_no_host_is_refused(address: str) -> None:
    with pytest.raises(InputError, match="is no mail address"):
        channel("mail").check(address, {})


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ({"PORT": "99999"}, "ELASTOGEO_SMTP_PORT is '99999'; give a number from 1 to 65535"),
        ({"PORT": "0"}, "ELASTOGEO_SMTP_PORT is '0'; give a number from 1 to 65535"),
        ({"HOST": "mail..example.com"}, "UnicodeError; give"),
    ],
)
def test_mail_settings_that_no_computer_can_take_are_an_error_of_delivery(more: dict[str, str], said: str) -> None:
    given = {"ELASTOGEO_SMTP_FROM": "a@example.com", "ELASTOGEO_SMTP_HOST": "localhost", "ELASTOGEO_SMTP_SECURITY": "none"}
    given |= {f"ELASTOGEO_SMTP_{name}": value for name, value in more.items()}
    with pytest.raises(DeliveryError, match=said):
        channel("mail").send(MESSAGE, "name@example.com", given)


def test_without_a_server_it_says_what_to_set() -> None:
    with pytest.raises(DeliveryError, match=r"set ELASTOGEO_SMTP_HOST"):
        channel("mail").send(MESSAGE, "a@example.com", {"ELASTOGEO_SMTP_FROM": "e@example.com"})
    closed = {"ELASTOGEO_SMTP_HOST": "127.0.0.1", "ELASTOGEO_SMTP_PORT": "1", "ELASTOGEO_SMTP_FROM": "e@example.com"}
    with pytest.raises(DeliveryError, match=r"ConnectionRefusedError"):
        channel("mail").send(MESSAGE, "a@example.com", closed)


# webhook

INSIDE = {"ELASTOGEO_WEBHOOK_PRIVATE": "yes"}


def test_a_post_carries_key_and_signature() -> None:
    with web_server() as server:
        address = f"http://127.0.0.1:{server.server_address[1]}/hook?of=3"
        channel("webhook").send(MESSAGE, address, INSIDE | {"ELASTOGEO_WEBHOOK_SECRET": "s3cret"})
    ((path, headers, body),) = server.posts
    assert path == "/hook?of=3"
    assert headers["Idempotency-Key"] == "k-17"
    assert json.loads(body) == MESSAGE.as_json()
    at = int(headers["X-Elastogeo-Signature"].split(",")[0].removeprefix("t="))
    assert headers["X-Elastogeo-Signature"] == webhook.signature(body, "s3cret", at)
    assert headers["X-Elastogeo-Signature"] != webhook.signature(body + b" ", "s3cret", at)


def test_the_signature_is_the_hmac_of_the_standard() -> None:
    """By `printf '1.what do ya want for nothing?' | openssl dgst -sha256 -hmac Jefe`."""
    made = webhook.signature(b"what do ya want for nothing?", "Jefe", 1)
    assert made == "t=1,v1=a9049465ce89cfb8e9aac62333abda66f80e3403f51f57f6bae3c3a4485eca38"


def test_https_is_checked_by_name_though_the_address_is_pinned(pem: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with web_server(pem=pem) as server:
        address = f"https://localhost:{server.server_address[1]}/"
        with pytest.raises(DeliveryError, match=r"(?i)certificate"):
            channel("webhook").send(MESSAGE, address, INSIDE)
        monkeypatch.setenv("SSL_CERT_FILE", str(pem))
        channel("webhook").send(MESSAGE, address, INSIDE)
        with pytest.raises(DeliveryError, match=r"(?i)mismatch"):
            channel("webhook").send(MESSAGE, address.replace("localhost", "127.0.0.1"), INSIDE)
    assert len(server.posts) == 1


@pytest.mark.parametrize("status", [301, 302, 307, 308])
def test_no_redirect_is_followed(status: int) -> None:
    with web_server() as other, web_server(status, to=f"http://127.0.0.1:{other.server_address[1]}/") as server:
        with pytest.raises(DeliveryError, match=rf"redirects \({status}\)"):
            channel("webhook").send(MESSAGE, f"http://127.0.0.1:{server.server_address[1]}/", INSIDE)
        assert other.posts == []


@pytest.mark.parametrize(("status", "lasting"), [(500, False), (404, False), (429, False), (410, True)])
def test_any_other_answer_is_tried_again_unless_the_receiver_is_gone(status: int, lasting: bool) -> None:
    with web_server(status) as server, pytest.raises(DeliveryError, match=f"answered {status}") as refused:
        channel("webhook").send(MESSAGE, f"http://127.0.0.1:{server.server_address[1]}/", INSIDE)
    assert refused.value.lasting is lasting


def test_a_receiver_that_answers_a_byte_at_a_time_is_cut_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(webhook, "DEADLINE", 0.3)
    with web_server(slow=True) as server, pytest.raises(DeliveryError, match=r"127.0.0.1"):
        channel("webhook").send(MESSAGE, f"http://127.0.0.1:{server.server_address[1]}/", INSIDE)


@pytest.mark.parametrize(
    "host",
    ["127.0.0.1", "localhost", "[::1]", "[::ffff:127.0.0.1]", "[::ffff:10.1.2.3]", "10.1.2.3", "192.168.1.1", "172.16.0.1",
     "169.254.169.254", "[fe80::1]", "[fc00::1]", "0.0.0.0", "2130706433", "0x7f.1", "100.64.0.1", "224.0.0.1",
     "[64:ff9b::a00:1]", "[2002:7f00:1::]"],
)  # fmt: skip
def test_private_addresses_are_refused_however_they_are_written(host: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def connected(*_: Any, **__: Any) -> None:
        raise AssertionError("a connection was made")

    monkeypatch.setattr(socket, "create_connection", connected)
    with pytest.raises(DeliveryError, match=r"no public address|is no web address") as refused:
        channel("webhook").send(MESSAGE, f"https://{host}/", {})
    assert refused.value.lasting


@pytest.mark.parametrize("address", ["8.8.8.8", "2606:4700::1111", "::ffff:8.8.8.8"])
def test_public_addresses_are_public(address: str) -> None:
    assert webhook.is_public(address)


def test_a_name_is_looked_up_once_and_all_its_addresses_count(monkeypatch: pytest.MonkeyPatch) -> None:
    """DNS rebinding: public at the check, private at the connection."""
    answers = [["93.184.216.34"], ["127.0.0.1"]]
    asked, reached = [], []

    def looked_up(host: str, port: int, **_: Any) -> list[Any]:
        asked.append(host)
        found = answers.pop(0)
        return [(socket.AF_INET, socket.SOCK_STREAM, 6, "", (address, port)) for address in found]

    def connected(address: tuple[str, int], *_: Any) -> None:
        reached.append(address)
        raise ConnectionRefusedError("not here")

    monkeypatch.setattr(socket, "getaddrinfo", looked_up)
    monkeypatch.setattr(socket, "create_connection", connected)
    with pytest.raises(DeliveryError, match=r"rebinds\.example: ConnectionRefusedError"):
        channel("webhook").send(MESSAGE, "https://rebinds.example/", {})
    assert (asked, reached) == (["rebinds.example"], [("93.184.216.34", 443)])
    answers[:] = [["93.184.216.34", "10.0.0.1"]]
    with pytest.raises(DeliveryError, match=r"is 10\.0\.0\.1, which is no public address"):
        channel("webhook").send(MESSAGE, "https://rebinds.example/", {})
    assert len(reached) == 1


@pytest.mark.parametrize(
    ("address", "why"),
    [
        ("http://example.com/", "give an address that begins with https://"),
        ("ftp://example.com/", "give an address that begins with https://"),
        ("file:///etc/passwd", "give an address that begins with https://"),
        ("https:///x", "needs a host"),
        ("https://user:pw@example.com/", "no user, password"),
        ("https://example.com/#x", "no user, password"),
        ("https://example.com:99999/", "correct its host or port"),
        ("https://example.com/\r\nX-Y: 1", "is no web address"),
        ("https://exämple.com/", "is no web address"),
        ("https://hooks..example.com/x", "correct its host or port"),
        (f"https://{'a' * 64}.example.com/x", "correct its host or port"),
    ],
)
def test_what_is_no_webhook_is_refused(address: str, why: str) -> None:
    with pytest.raises(InputError, match=why):
        channel("webhook").check(address, {})


def test_a_message_has_a_largest_size() -> None:
    with pytest.raises(DeliveryError, match=r"a webhook takes 262144"):
        channel("webhook").send(Message("k", "s", "x" * 300_000), "https://example.com/", {})
