"""A mail server and a web server of a few lines, on this computer, that keep what they are sent."""

from __future__ import annotations

import socketserver
import ssl
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime, timedelta
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path
from threading import Thread
from typing import Any

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import NameOID


def certificate(folder: Path) -> Path:
    """A certificate for localhost with its key, signed by itself, in one file."""
    key = ec.generate_private_key(ec.SECP256R1())
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "localhost")])
    now = datetime.now(UTC)
    names = [x509.DNSName("localhost")]
    made = (
        x509.CertificateBuilder()
        .subject_name(name)
        .issuer_name(name)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - timedelta(days=1))
        .not_valid_after(now + timedelta(days=1))
        .add_extension(x509.SubjectAlternativeName(names), critical=False)
        .add_extension(x509.BasicConstraints(ca=True, path_length=None), critical=True)
        .sign(key, hashes.SHA256())
    )
    path = folder / "localhost.pem"
    private = key.private_bytes(serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption())
    path.write_bytes(private + made.public_bytes(serialization.Encoding.PEM))
    return path


class _Smtp(socketserver.StreamRequestHandler):
    """One session: what is said and the letters are kept in the server; `refuse` answers a recipient with that code."""

    def handle(self) -> None:
        server: Any = self.server
        self.say("220 here")
        while line := self.rfile.readline():
            word, _, rest = line.decode().strip().partition(" ")
            word = word.upper()
            server.said.append((word, rest, server.secure is not None and isinstance(self.connection, ssl.SSLSocket)))
            if word == "STARTTLS" and server.secure is not None:
                self.say("220 go on")
                self.connection = server.secure.wrap_socket(self.connection, server_side=True)
                self.rfile, self.wfile = self.connection.makefile("rb"), self.connection.makefile("wb", 0)
            elif word == "EHLO":
                offered = "250-here\r\n250-AUTH PLAIN LOGIN\r\n" + ("250-STARTTLS\r\n" if server.secure is not None else "")
                self.say(offered + "250 SIZE 1000000")
            elif word == "AUTH":
                self.say("235 in" if server.password else "535 5.7.8 no: " + rest)
            elif word == "RCPT" and server.refuse:
                self.say(f"{server.refuse} not today")
            elif word == "DATA":
                self.say("354 go on")
                letter = []
                while (part := self.rfile.readline()) != b".\r\n":
                    letter.append(part)
                server.letters.append(b"".join(letter))
                self.say("250 taken")
            elif word == "QUIT":
                self.say("221 bye")
                return
            else:
                self.say("250 ok")

    def finish(self) -> None:
        super().finish()
        self.connection.close()

    def say(self, answer: str) -> None:
        self.wfile.write(f"{answer}\r\n".encode())


@contextmanager
def running(server: socketserver.BaseServer) -> Iterator[Any]:
    server.handle_error = lambda *_: None  # type: ignore[method-assign]  # a client that hangs up is what is tested
    thread = Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True)
    thread.start()
    try:
        yield server
    finally:
        server.shutdown()
        server.server_close()
        thread.join()


@contextmanager
def mail_server(pem: Path | None = None, refuse: int = 0, password: bool = True) -> Iterator[Any]:
    server: Any = socketserver.TCPServer(("127.0.0.1", 0), _Smtp)
    server.letters, server.said, server.refuse, server.password = [], [], refuse, password
    server.secure = None
    if pem is not None:
        server.secure = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        server.secure.load_cert_chain(pem)
    with running(server):
        yield server


class _Web(BaseHTTPRequestHandler):
    """Answers every post as its server says: a status, a place to go to, or a byte at a time."""

    def do_POST(self) -> None:
        server: Any = self.server
        body = self.rfile.read(int(self.headers["Content-Length"]))
        server.posts.append((self.path, dict(self.headers), body))
        if server.slow:
            for _ in range(100):
                try:
                    self.wfile.write(b"H")
                    time.sleep(0.05)
                except OSError:
                    return
        self.send_response(server.status)
        if server.to:
            self.send_header("Location", server.to)
        self.end_headers()

    def log_message(self, *_: Any) -> None:
        """Say nothing."""


@contextmanager
def web_server(status: int = 204, to: str = "", pem: Path | None = None, slow: bool = False) -> Iterator[Any]:
    server: Any = HTTPServer(("127.0.0.1", 0), _Web)
    server.posts, server.status, server.to, server.slow = [], status, to, slow
    if pem is not None:
        secure = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        secure.load_cert_chain(pem)
        server.socket = secure.wrap_socket(server.socket, server_side=True)
    with running(server):
        yield server
