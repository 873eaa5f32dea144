"""The body of an upload, taken as it comes: nothing of it is held in memory, and nothing is kept of one that breaks off."""

from __future__ import annotations

from collections.abc import AsyncIterator, Awaitable, Callable

from fastapi.concurrency import run_in_threadpool
from python_multipart.exceptions import FormParserError
from python_multipart.multipart import MultipartParser, parse_options_header
from starlette.datastructures import Headers

from elastogeo.errors import InputError
from elastogeo.history import Store
from elastogeo.history.parcels import LARGEST, MOST_FILES, Arriving, arriving, too_large

_AT_ONCE = 2**18
"""Bytes that are gathered before they are written."""
_FORM = 2**20
"""Bytes that a form may hold beside its files."""
_MOST_PARTS = MOST_FILES + 100
"""Files and other fields of a form: each costs time, however small."""
_LONGEST = 8192
"""Bytes of a heading within a form."""
_BROKE_OFF = "what was sent broke off; send it again"


async def received(
    store: Store, blocks: AsyncIterator[bytes], headers: Headers, name: str, still: Callable[[], Awaitable[None]]
) -> str:
    """Take an upload.

    Parameters
    ----------
    store : Store
    blocks : async iterator of bytes
        The body of the request.
    headers : Headers
        Its content type is `multipart/form-data` of a form, or anything else for one file as it is.
    name : str
        How the sender calls that one file.
    still : callable
        Refuses a sender who, when all has come, may not send any more.

    Returns
    -------
    str
        The name of the parcel; all of it is on the disk.

    Raises
    ------
    InputError
        If nothing came, too much, or what came is no form; nothing is kept of it then.
    """
    length = headers.get("content-length", "")
    if length.isdigit() and int(length) > LARGEST + _FORM:
        raise InputError(too_large())
    parcel, size = await run_in_threadpool(arriving, store.files), 0
    try:
        take, end = _taken(parcel, headers.get("content-type", ""), name)
        waiting = bytearray()
        async for block in blocks:
            waiting += block
            size += len(block)
            if size > LARGEST + _FORM:
                raise InputError(too_large())
            if len(waiting) >= _AT_ONCE:
                await run_in_threadpool(take, bytes(waiting))
                waiting.clear()
        await run_in_threadpool(take, bytes(waiting))
        await run_in_threadpool(end)
        await still()
        return await run_in_threadpool(parcel.keep)
    except BaseException:
        parcel.drop()
        raise


def _taken(parcel: Arriving, kind: str, name: str) -> tuple[Callable[[bytes], None], Callable[[], None]]:
    """What takes the bytes of a body, and what is called at its end."""
    main, options = parse_options_header(kind)
    if main != b"multipart/form-data":
        parcel.begin(name or "sent")
        return parcel.write, lambda: None
    if not options.get(b"boundary"):
        raise InputError("what was sent is no form with files; choose them on the page of uploads")
    form = _Form(parcel, options[b"boundary"])
    return form.take, form.end


class _Form:
    """A form that comes in: its files go into a parcel, its other fields nowhere."""

    def __init__(self, parcel: Arriving, boundary: bytes) -> None:
        self._parcel = parcel
        self._field, self._value, self._disposition = b"", b"", b""
        self._is_file = self._whole = False
        self._parts = 0
        self._parser = MultipartParser(
            boundary,
            {
                "on_part_begin": self._begin,
                "on_header_field": self._on_field,
                "on_header_value": self._on_value,
                "on_header_end": self._on_header,
                "on_headers_finished": self._on_headers,
                "on_part_data": self._on_data,
                "on_end": self._on_end,
            },
        )

    def take(self, data: bytes) -> None:
        """Take bytes of the body."""
        try:
            self._parser.write(data)
        except FormParserError:
            raise InputError(_BROKE_OFF) from None

    def end(self) -> None:
        """Refuse a form that did not come to its end."""
        if not self._whole:
            raise InputError(_BROKE_OFF)

    def _begin(self) -> None:
        self._parts += 1
        if self._parts > _MOST_PARTS:
            raise InputError("what was sent has too many parts; send the tests in several parts")
        self._field, self._value, self._disposition, self._is_file = b"", b"", b"", False

    def _on_field(self, data: bytes, start: int, end: int) -> None:
        self._field += data[start:end]
        if len(self._field) > _LONGEST:
            raise InputError(_BROKE_OFF)

    def _on_value(self, data: bytes, start: int, end: int) -> None:
        self._value += data[start:end]
        if len(self._value) > _LONGEST:
            raise InputError("a file has too long a name; rename it")

    def _on_header(self) -> None:
        if self._field.lower() == b"content-disposition":
            self._disposition = self._value
        self._field = self._value = b""

    def _on_headers(self) -> None:
        _, options = parse_options_header(self._disposition)
        name = options.get(b"filename", b"")
        if name:
            self._is_file = True
            self._parcel.begin(name.decode("utf-8", "replace"))

    def _on_data(self, data: bytes, start: int, end: int) -> None:
        if self._is_file:
            self._parcel.write(data[start:end])

    def _on_end(self) -> None:
        self._whole = True
