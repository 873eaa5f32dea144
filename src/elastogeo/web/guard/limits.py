"""How much, and how slowly."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Limits:
    """What a request may take.

    Attributes
    ----------
    address, headers : int [bytes]
        The longest address, and all headers together.
    body : int [bytes]
        Of a form.
    upload : int [bytes]
        Of what is sent to `/upload`, counted as it is read.
    patience : float [s]
        For the headers; for a body, beyond the time that it takes at `rate`.
    rate : float [bytes/s]
        The slowest body.
    """

    address: int = 8 * 1024
    headers: int = 16 * 1024
    body: int = 64 * 1024
    upload: int = 100_000_000
    patience: float = 20.0
    rate: float = 8 * 1024

    def of_body(self, method: str, path: str) -> int:
        """The largest body of a request."""
        return self.upload if method == "POST" and (path == "/upload" or path.startswith("/upload/")) else self.body
