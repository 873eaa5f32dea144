"""The channel `webhook`: the message as JSON, posted to an address of the web.

https only; no redirects; no address of a private network, of this computer or of a link. `ELASTOGEO_WEBHOOK_PRIVATE=yes`
lets private addresses and http be used, for a server in the same house. With `ELASTOGEO_WEBHOOK_SECRET` each message is
signed: `X-Elastogeo-Signature: t=TIME,v1=HEX`, the HMAC-SHA256 of `TIME.` and the body.
"""

from __future__ import annotations

import hmac
import http.client
import ipaddress
import json
import socket
import ssl
import time
from contextlib import suppress
from threading import Timer
from urllib.parse import SplitResult, urlsplit

from elastogeo.errors import DeliveryError, InputError
from elastogeo.history.alarms.channels.channel import Channel, Message, Settings, register
from elastogeo.history.alarms.channels.hosts import is_host, is_of_this_computer
from elastogeo.version import VERSION

TIMEOUT = 10.0
"""Seconds for each answer of the receiver."""
DEADLINE = 30.0
"""Seconds for all of it: a receiver that answers a byte at a time is cut off."""
LARGEST = 256 * 1024
"""Bytes of a message."""
GONE = 410

Address = ipaddress.IPv4Address | ipaddress.IPv6Address

_EMBEDDED = ipaddress.IPv6Network("64:ff9b::/96")


def check(address: str, settings: Settings) -> None:
    """Refuse what is no web address, and what may not be one; the network is asked only when a message is sent."""
    _parts(address, settings)


def send(message: Message, address: str, settings: Settings) -> None:
    """Post the message to the very address that was looked up and allowed."""
    try:
        parts = _parts(address, settings)
    except InputError as error:
        raise DeliveryError(str(error), lasting=True) from None
    body = json.dumps(message.as_json(), ensure_ascii=True).encode()
    if len(body) > LARGEST:
        raise DeliveryError(f"the message has {len(body)} bytes; a webhook takes {LARGEST}", lasting=True)
    try:
        status = _post(parts, _resolved(parts, settings), body, _headers(message, body, settings))
    except (OSError, http.client.HTTPException) as error:
        raise DeliveryError(f"{parts.hostname}: {type(error).__name__}: {error}") from None
    if 300 <= status < 400:
        raise DeliveryError(f"{parts.hostname} redirects ({status}), which is not followed; enter the final address")
    if not 200 <= status < 300:
        raise DeliveryError(f"{parts.hostname} answered {status}", lasting=status == GONE)


def _parts(address: str, settings: Settings) -> SplitResult:
    if not address.isascii() or not address.isprintable() or " " in address:
        raise InputError(f"{address!r} is no web address; give one of plain letters, as https://example.com/alarms")
    try:
        parts = urlsplit(address)
        port = parts.port
    except ValueError:
        raise InputError(f"{address!r} is no web address; correct its host or port") from None
    allowed = ("https", "http") if _private_allowed(settings) else ("https",)
    if parts.scheme not in allowed:
        raise InputError(
            f"{address!r}: give an address that begins with https://; http is taken with ELASTOGEO_WEBHOOK_PRIVATE=yes only"
        )
    if not parts.hostname or port == 0:
        raise InputError("a webhook needs a host: https://example.com/alarms")
    _check_host(parts.hostname, settings)
    if parts.username is not None or parts.password is not None or parts.fragment:
        raise InputError("a webhook has no user, password or # part; sign it by ELASTOGEO_WEBHOOK_SECRET")
    return parts


def _check_host(host: str, settings: Settings) -> None:
    """Refuse what is known to be out of reach without asking the network."""
    try:
        public = is_public(host)
    except ValueError:  # a name, no address
        if not is_host(host):
            raise InputError(
                f"{host!r} is no web address: no such name can be looked up; correct its host or port"
            ) from None
        public = not is_of_this_computer(host)
    if not public and not _private_allowed(settings):
        raise InputError(
            f"{host} is no public address; give one that is, or set ELASTOGEO_WEBHOOK_PRIVATE=yes for a server in the house"
        )


def _private_allowed(settings: Settings) -> bool:
    return settings.get("ELASTOGEO_WEBHOOK_PRIVATE", "") == "yes"


def _resolved(parts: SplitResult, settings: Settings) -> str:
    """The address to connect to, looked up once: a name that changes its address after the check gains nothing."""
    host = str(parts.hostname)
    found = socket.getaddrinfo(host, _port(parts), type=socket.SOCK_STREAM)
    addresses = [str(entry[4][0]) for entry in found]
    if not _private_allowed(settings):
        for address in addresses:
            if not is_public(address):
                raise DeliveryError(
                    f"{host} is {address}, which is no public address; ELASTOGEO_WEBHOOK_PRIVATE=yes allows it", lasting=True
                )
    return addresses[0]


def is_public(address: str) -> bool:
    """Whether an IP address is of the public network, also what an IPv6 address hides inside."""
    ip: Address = ipaddress.ip_address(address.partition("%")[0])
    if not ip.is_global or ip.is_multicast:
        return False
    return all(inner.is_global for inner in _inner(ip)) if isinstance(ip, ipaddress.IPv6Address) else True


def _inner(ip: ipaddress.IPv6Address) -> list[Address]:
    inner: list[Address] = [found for found in (ip.ipv4_mapped, ip.sixtofour, *(ip.teredo or ())) if found is not None]
    if ip in _EMBEDDED:
        inner.append(ipaddress.IPv4Address(int(ip) & 0xFFFFFFFF))
    return inner


def _port(parts: SplitResult) -> int:
    return parts.port or (443 if parts.scheme == "https" else 80)


def _headers(message: Message, body: bytes, settings: Settings) -> dict[str, str]:
    headers = {
        "Content-Type": "application/json",
        "User-Agent": f"elastogeo/{VERSION}",
        "Idempotency-Key": message.key,
    }
    secret = settings.get("ELASTOGEO_WEBHOOK_SECRET", "")
    if secret:
        headers["X-Elastogeo-Signature"] = signature(body, secret, int(time.time()))
    return headers


def signature(body: bytes, secret: str, at: int) -> str:
    """The value of `X-Elastogeo-Signature`: a receiver computes it again and refuses what is not the same, or old."""
    return f"t={at},v1={hmac.new(secret.encode(), f'{at}.'.encode() + body, 'sha256').hexdigest()}"


class _Pinned(http.client.HTTPConnection):
    """A connection to one IP address, whatever the name means by now; the certificate is still the name's."""

    def __init__(self, parts: SplitResult, address: str) -> None:
        super().__init__(str(parts.hostname), _port(parts), timeout=TIMEOUT)
        self._address = address
        self._context = ssl.create_default_context() if parts.scheme == "https" else None

    def connect(self) -> None:
        self.sock = socket.create_connection((self._address, self.port), self.timeout)
        if self._context is not None:
            secure = self._context.wrap_socket(self.sock, server_hostname=self.host, do_handshake_on_connect=False)
            self.sock = secure  # before the handshake, so that it can be cut off too
            secure.do_handshake()

    def cut(self) -> None:
        """End whatever goes on."""
        if self.sock is not None:
            with suppress(OSError):
                socket.socket.shutdown(self.sock, socket.SHUT_RDWR)


def _post(parts: SplitResult, address: str, body: bytes, headers: dict[str, str]) -> int:
    connection = _Pinned(parts, address)
    watch = Timer(DEADLINE, connection.cut)
    watch.daemon = True
    watch.start()
    try:
        connection.request("POST", (parts.path or "/") + (f"?{parts.query}" if parts.query else ""), body, headers)
        return connection.getresponse().status  # what it says beside that is not read
    finally:
        watch.cancel()
        connection.close()


register(Channel("webhook", check, send, sample="https://example.com/alarms"))
