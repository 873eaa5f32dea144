"""The blocks of an MDF 4 file: found, checked and unpacked, none of them twice, none beyond its caps."""

from __future__ import annotations

import re
import struct
import zlib
from collections.abc import Iterator

import numpy as np

from elastogeo.errors import FormatError

RATIO = 8
LEAST_UNPACKED = 10_000_000
MAX_BLOCKS = 20_000
MAX_TEXT = 2000

_TX = re.compile(r"<TX[^>]{0,100}>([^<]*)</TX>")


class Blocks:
    """The blocks of a file; each is entered once only."""

    def __init__(self, data: bytes, source: str) -> None:
        self.data, self.source = data, source
        self.entered: set[int] = set()
        self.unpacked = self.values = 0

    def block(self, address: int, kind: bytes, links: int, *, again: bool = False) -> tuple[tuple[int, ...], memoryview]:
        """The first links of a block of this kind, and its body (a view of the file).

        Raises
        ------
        FormatError
            If it does not lie in the file, is of another kind, or was entered before.
        """
        if address in self.entered and not again:
            raise self.error(f"block {kind.decode()} at byte {address} is linked to twice")
        self.entered.add(address)
        head = self.data[address : address + 24] if 0 < address < len(self.data) else b""
        if len(head) < 24 or head[:4] != kind or len(self.entered) > MAX_BLOCKS:
            raise self.error(f"a block {kind.decode()} is missing at byte {address}")
        length, count = struct.unpack_from("<QQ", head, 8)
        if count < links or 24 + 8 * count > length or address + length > len(self.data):
            raise self.error(f"block {kind.decode()} at byte {address} does not lie whole in the file")
        view = memoryview(self.data)[address : address + length]
        return struct.unpack_from(f"<{links}Q", view, 24), view[24 + 8 * count :]

    def error(self, reason: str) -> FormatError:
        """The error of a damaged file."""
        return FormatError(f"{self.source}: the MDF file is cut off or damaged ({reason}); copy or save it again")

    def need(self, body: memoryview, size: int) -> memoryview:
        """A body of at least this size."""
        if len(body) < size:
            raise self.error("a block is too short")
        return body

    def kind(self, address: int) -> bytes:
        """The kind of the block at this address."""
        return self.data[address : address + 4] if address else b""

    def text(self, address: int) -> str:
        """The text of a block TX, or the first text of an MD; empty if there is none."""
        kind = self.kind(address)
        if kind not in (b"##TX", b"##MD"):
            return ""
        text = text_of(bytes(self.block(address, kind, 0, again=True)[1][:MAX_TEXT]))
        found = _TX.search(text) if kind == b"##MD" else None
        return found[1].strip() if found else "" if kind == b"##MD" else text

    def pieces(self, address: int) -> Iterator[bytes | memoryview]:
        """The data of a block DT or DZ, or of all in a list (DL, HL)."""
        kind = self.kind(address)
        if kind == b"##DT":
            piece = self.block(address, kind, 0)[1]
            self.count(len(piece))
            yield piece
        elif kind == b"##DZ":
            yield self._unpack(address)
        elif kind == b"##HL":
            first = self.block(address, kind, 1)[0][0]
            if self.kind(first) != b"##DL":
                raise self.error(f"no list of data at byte {first}")
            yield from self.pieces(first)
        elif kind == b"##DL":
            while address:
                count = struct.unpack_from("<Q", self.data, address + 16)[0] if address + 24 <= len(self.data) else 0
                links = self.block(address, b"##DL", min(count, len(self.data) // 8))[0]
                for link in links[1:]:
                    if link and self.kind(link) not in (b"##DT", b"##DZ"):
                        raise self.error(f"no data block at byte {link}")
                    yield from self.pieces(link)
                address = links[0] if links else 0
        elif kind in (b"##LD", b"##DV"):
            raise FormatError(f"{self.source}: is stored by columns ({kind[2:].decode()}); save it as MDF 4.10")
        elif address:
            raise self.error(f"no data block at byte {address}")

    def count(self, size: int) -> None:
        """Count bytes of data against the cap."""
        self.unpacked += size
        if self.unpacked > max(LEAST_UNPACKED, RATIO * len(self.data)):
            raise FormatError(
                f"{self.source}: {len(self.data)} bytes unpack to more than {RATIO} times that; save it unpacked"
            )

    def count_values(self, count: int) -> None:
        """Count values to be given against what the data can hold."""
        self.values += count
        if self.values > 1_000_000 + max(self.unpacked, len(self.data)):
            raise FormatError(
                f"{self.source}: {len(self.data)} bytes claim more than {self.values - count} values; save it again"
            )

    def _unpack(self, address: int) -> bytes:
        body = self.need(self.block(address, b"##DZ", 0)[1], 24)
        kind, how, width, size, packed = struct.unpack_from("<2sBxIQQ", body)
        if kind != b"DT" or how not in (0, 1) or packed > len(body) - 24 or (how == 1 and not width):
            raise self.error(f"the packed block at byte {address} is not of a kind that is read")
        self.count(size)
        try:
            engine = zlib.decompressobj()
            raw = engine.decompress(body[24 : 24 + packed], size + 1)
        except zlib.error as error:
            raise self.error(f"the packed block at byte {address}: {error}") from None
        if len(raw) != size or not engine.eof:
            raise self.error(f"the packed block at byte {address} does not hold {size} bytes")
        if how == 1:
            rows = size // width
            whole = np.frombuffer(raw[: rows * width], np.uint8).reshape(width, rows).T
            raw = whole.tobytes() + raw[rows * width :]
        return raw


def text_of(raw: bytes) -> str:
    """Text that ends at a zero byte."""
    return raw.split(b"\0")[0].decode("utf-8", "replace").strip()
