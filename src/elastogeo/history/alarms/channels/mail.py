"""The channel `mail`: to an address, by the SMTP server that the environment names.

`ELASTOGEO_SMTP_HOST`, `ELASTOGEO_SMTP_FROM`; `ELASTOGEO_SMTP_PORT` (587), `ELASTOGEO_SMTP_SECURITY` (`starttls`, `tls`, or
`none` for a server in the same house), `ELASTOGEO_SMTP_USER` and `ELASTOGEO_SMTP_PASSWORD`. No password goes over a line
that is not encrypted.
"""

from __future__ import annotations

import re
import smtplib
import ssl
from email.message import EmailMessage
from email.policy import SMTP
from email.utils import format_datetime, localtime

from elastogeo.errors import DeliveryError, InputError
from elastogeo.history.alarms.channels.channel import Channel, Message, Settings, register
from elastogeo.history.alarms.channels.hosts import is_host

TIMEOUT = 10.0
"""Seconds for each answer of the server."""
LONGEST = 200
"""Characters of a subject."""

_ATOM = r"[A-Za-z0-9!#$%&'*+/=?^_`{|}~-]+"
_ADDRESS = re.compile(rf"(?=.{{1,64}}@){_ATOM}(?:\.{_ATOM})*@(.{{1,253}})")
"""A dot-atom of RFC 5322, 3.2.3, and a host."""
_SECURITY = ("starttls", "tls", "none")


def check(address: str, settings: Settings) -> None:  # noqa: ARG001
    """Refuse what is not one plain address: a line break in it would add headers of its own."""
    if not _is_address(address):
        raise InputError(f"{address!r} is no mail address; give one, as name@example.com, without a display name")


def _is_address(text: str) -> bool:
    """Whether it is one plain address of a host that can be looked up."""
    found = _ADDRESS.fullmatch(text)
    return found is not None and is_host(found[1])


def send(message: Message, address: str, settings: Settings) -> None:
    """Hand the message to the server."""
    host = _host(settings)
    letter = _letter(message, address, settings)
    try:
        with _session(host, settings) as server:
            server.send_message(letter)
    except smtplib.SMTPRecipientsRefused as error:
        code, said = next(iter(error.recipients.values()))
        raise DeliveryError(f"{host} refused {address}: {code} {_short(said)}", lasting=code >= 500) from None
    except smtplib.SMTPAuthenticationError as error:
        raise DeliveryError(f"{host} refused the user or the password ({error.smtp_code})") from None
    except smtplib.SMTPResponseException as error:
        raise DeliveryError(f"{host} answered {error.smtp_code} {_short(error.smtp_error)}") from None
    except UnicodeError as error:  # its text would show a password that is not of plain letters
        raise DeliveryError(
            f"{type(error).__name__}; give ELASTOGEO_SMTP_HOST, _USER and _PASSWORD in plain letters"
        ) from None
    except (smtplib.SMTPException, OSError) as error:
        raise DeliveryError(f"{host}: {type(error).__name__}: {_short(str(error))}") from None


def _letter(message: Message, address: str, settings: Settings) -> EmailMessage:
    sender = settings.get("ELASTOGEO_SMTP_FROM", "")
    for given in (address, sender):
        if not _is_address(given):
            raise DeliveryError(
                f"{given!r} is no mail address; correct the recipient, or ELASTOGEO_SMTP_FROM", lasting=given == address
            )
    letter = EmailMessage(policy=SMTP)
    letter["From"], letter["To"] = sender, address
    letter["Subject"] = _one_line(message.subject)
    letter["Date"] = format_datetime(localtime())
    letter["Message-ID"] = f"<{re.sub(r'[^A-Za-z0-9.-]', '', message.key)}@{sender.rpartition('@')[2]}>"
    letter["Auto-Submitted"] = "auto-generated"
    letter.set_content(message.text)
    return letter


def _one_line(text: str) -> str:
    printable = "".join(sign if sign.isprintable() else " " for sign in text)
    return " ".join(printable.split())[:LONGEST]


def _host(settings: Settings) -> str:
    host = settings.get("ELASTOGEO_SMTP_HOST", "")
    if not host:
        raise DeliveryError("no mail server is known; set ELASTOGEO_SMTP_HOST and ELASTOGEO_SMTP_FROM")
    return host


def _session(host: str, settings: Settings) -> smtplib.SMTP:
    security = settings.get("ELASTOGEO_SMTP_SECURITY", "starttls")
    if security not in _SECURITY:
        raise DeliveryError(f"ELASTOGEO_SMTP_SECURITY is {security!r}; it is {', '.join(_SECURITY)}")
    user, password = settings.get("ELASTOGEO_SMTP_USER", ""), settings.get("ELASTOGEO_SMTP_PASSWORD", "")
    if user and security == "none":
        raise DeliveryError(
            "a password is not sent over a line that is not encrypted; set ELASTOGEO_SMTP_SECURITY to starttls"
        )
    given = settings.get("ELASTOGEO_SMTP_PORT", "465" if security == "tls" else "587")
    if not (given.isdecimal() and len(given) <= len("65535") and 0 < int(given) <= 65535):
        raise DeliveryError(f"ELASTOGEO_SMTP_PORT is {given!r}; give a number from 1 to 65535")
    context = ssl.create_default_context()
    server: smtplib.SMTP
    if security == "tls":
        server = smtplib.SMTP_SSL(host, int(given), timeout=TIMEOUT, context=context)
    else:
        server = smtplib.SMTP(host, int(given), timeout=TIMEOUT)
    try:
        if security == "starttls":
            server.starttls(context=context)  # raises where the server has none: never in the clear by accident
        if user:
            server.login(user, password)
    except BaseException:
        server.close()
        raise
    return server


def _short(said: bytes | str) -> str:
    return _one_line(said.decode("utf-8", "replace") if isinstance(said, bytes) else said)


register(Channel("mail", check, send, sample="name@example.com"))
