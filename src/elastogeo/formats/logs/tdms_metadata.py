"""The metadata of a TDMS file, walked before npTDMS reads them: every length in them stays within the bytes that are there.

The layout is that of npTDMS's own reader (`tdms_segment.py`, `daqmx.py`) and of National Instruments' description of the
format: lead-ins of 28 bytes; lists of objects with their path, index of raw data and properties.
"""

from __future__ import annotations

import struct

from elastogeo.errors import FormatError

TAG = b"TDSm"
LEAST = 2000
"""Objects and pieces that any file may have, however small it is."""

_LEAD = 28
_META, _NEW, _BIG = 1 << 1, 1 << 2, 1 << 6
_BYTES_PER_OBJECT = 10
_NO_DATA, _AS_BEFORE = 0xFFFFFFFF, 0
_SCALERS = {0x1269: 20, 0x126A: 17}
"""Bytes of a scaler by the kind of index: format changing, digital line."""
_STRING = 0x20
_SIZES = {0x00: 1, 0x01: 1, 0x02: 2, 0x03: 4, 0x04: 8, 0x05: 1, 0x06: 2, 0x07: 4, 0x08: 8, 0x09: 4, 0x0A: 8}
_SIZES |= {0x19: 4, 0x1A: 8, 0x21: 1, 0x44: 16, 0x08000C: 8, 0x10000D: 16}
"""Bytes of a property by its type."""


def check_segments(data: bytes, source: str) -> None:
    """Check that whole segments fill a file, and that their metadata promise no more than there is.

    Raises
    ------
    FormatError
        If one is cut off, was never finished, or is damaged; or if all list more objects than the size allows.
    """
    at = objects = listed = 0
    while at < len(data) or not at:
        lead = data[at : at + _LEAD]
        if len(lead) < _LEAD or not lead.startswith(TAG):
            raise FormatError(
                f"{source}: no TDMS segment begins at byte {at}; the file is cut off or damaged; copy it again"
            )
        toc = int.from_bytes(lead[4:8], "little")
        order = ">" if toc & _BIG else "<"
        length, raw = struct.unpack(order + "QQ", lead[12:28])
        if length == 0xFFFFFFFFFFFFFFFF:
            raise FormatError(f"{source}: the segment at byte {at} was never finished (the program crashed); save it again")
        if at + _LEAD + length > len(data) or raw > length or (toc & _META and raw < 4):
            raise FormatError(
                f"{source}: the segment at byte {at} claims {length} bytes, {len(data) - at - _LEAD} follow; the file is "
                "cut off or damaged; copy it again"
            )
        if toc & _META:
            here = struct.unpack(order + "L", data[at + _LEAD : at + _LEAD + 4])[0]
            objects = here if toc & _NEW else objects + here
        listed += objects + 1
        if listed > LEAST + len(data) // _BYTES_PER_OBJECT:
            raise FormatError(f"{source}: lists more objects than its size allows; save it again, defragmented")
        if toc & _META:
            _Walk(data, at + _LEAD, at + _LEAD + raw, order, source).objects()
        at += _LEAD + length


class _Walk:
    """A way through the metadata of one segment, from `at` to `end`."""

    def __init__(self, data: bytes, at: int, end: int, order: str, source: str) -> None:
        self.data, self.at, self.end, self.order, self.source = data, at, end, order, source

    def objects(self) -> None:
        for _ in range(self._number()):
            self._skip(self._number())
            index = self._number()
            if index not in (_NO_DATA, _AS_BEFORE):
                self._index(index)
            for _ in range(self._number()):
                self._skip(self._number())
                self._property(self._number())

    def _index(self, kind: int) -> None:
        """The index of raw data of an object: type, dimension, number of values; of DAQmx, its scalers and buffers."""
        of_type = self._number()
        self._skip(12)
        if kind in _SCALERS:
            self._skip(_SCALERS[kind] * self._number())
            self._skip(4 * self._number())
        elif of_type == _STRING:
            self._skip(8)

    def _property(self, kind: int) -> None:
        size = self._number() if kind == _STRING else _SIZES.get(kind)
        if size is None:
            raise FormatError(
                f"{self.source}: a property before byte {self.at} is of the unknown type {kind:#x}; save it again"
            )
        self._skip(size)

    def _number(self) -> int:
        start = self.at
        self._skip(4)
        return int(struct.unpack_from(self.order + "L", self.data, start)[0])

    def _skip(self, count: int) -> None:
        if self.at + count > self.end:
            raise FormatError(
                f"{self.source}: the metadata at byte {self.at} claim {count} bytes, {self.end - self.at} are left; the "
                "file is damaged; copy or save it again"
            )
        self.at += count
