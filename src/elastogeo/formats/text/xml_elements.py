"""XML read safely, as a small tree or event by event: no document type, no entity, caps on size, depth, elements, tags."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

from defusedxml.ElementTree import DefusedXMLParser  # type: ignore[import-untyped,unused-ignore]

from elastogeo.errors import FormatError

MAX_BYTES = 100_000_000
MAX_DEPTH = 100
MAX_ELEMENTS = 20_000
MAX_TAG = 10_000
_PIECE = 65_536

_LONG_TAG = re.compile(rb"<[^<>]{%d}" % MAX_TAG)


@dataclass(slots=True)
class Element:
    """One element of a document.

    Attributes
    ----------
    tag : str
        Its name, without a namespace.
    attributes : dict of str to str
    children : list of Element
    text : str
        What stands in it before and between its children, without blanks around.
    """

    tag: str
    attributes: dict[str, str]
    children: list[Element] = field(default_factory=list)
    text: str = ""

    def walk(self, *without: str) -> Iterator[Element]:
        """All elements below it, in their order, but for those of these tags and what is in them."""
        for child in self.children:
            if child.tag not in without:
                yield child
                yield from child.walk(*without)


class Target(Protocol):
    """What is told of each element of a document as it is read."""

    def start(self, tag: str, attributes: Mapping[str, str]) -> None:
        """Be told that an element begins."""

    def data(self, text: str) -> None:
        """Be told a piece of text in the element that is open."""

    def end(self, tag: str) -> None:
        """Be told that the element ends."""

    def close(self) -> Any:
        """Give the result when the document has ended."""


class _Builder:
    """What the parser builds into: a tree within the caps."""

    def __init__(self, source: str) -> None:
        self.source, self.count = source, 0
        self.root = Element("", {})
        self.open: list[tuple[Element, io.StringIO]] = []

    def start(self, tag: str, attributes: Mapping[str, str]) -> None:
        """Open an element."""
        self.count += 1
        if len(self.open) >= MAX_DEPTH or self.count > MAX_ELEMENTS:
            most = f"more than {MAX_DEPTH} elements inside each other" if self.count <= MAX_ELEMENTS else "too many elements"
            raise FormatError(f"{self.source}: has {most} (<{tag[:40]}>), more than any test needs; check what it is")
        element = Element(local(tag), {local(name): value for name, value in attributes.items()})
        if self.open:
            self.open[-1][0].children.append(element)
        else:
            self.root = element
        self.open.append((element, io.StringIO()))

    def data(self, text: str) -> None:
        """Take text."""
        self.open[-1][1].write(text)

    def end(self, tag: str) -> None:  # noqa: ARG002
        """Close the element."""
        element, text = self.open.pop()
        element.text = text.getvalue().strip()

    def close(self) -> Element:
        """The root."""
        return self.root


def read_elements(data: bytes, source: str) -> Element:
    """Read an XML document into a tree.

    Parameters
    ----------
    data : bytes
    source : str
        Where they came from, for messages.

    Returns
    -------
    Element
        The root.

    Raises
    ------
    FormatError
        If it is no well-formed XML, has a document type or an entity, or exceeds a cap.
    """
    root: Element = feed_elements(data, source, _Builder(source))
    return root


def feed_elements(data: bytes, source: str, target: Target) -> Any:
    """Read an XML document event by event, so that it may hold more elements than a tree should; give `target.close()`.

    Parameters
    ----------
    data : bytes
    source : str
        Where they came from, for messages.
    target : Target
        Is told of each element, with its name as the parser gives it (`{namespace}name`). It keeps its own caps on depth
        and number of elements.

    Raises
    ------
    FormatError
        If it is no well-formed XML, has a document type or an entity, is too large or has a tag that is too long.
    """
    if len(data) > MAX_BYTES:
        raise FormatError(f"{source}: is larger than {MAX_BYTES // 1_000_000} MB, which is too large for XML; split it")
    if _LONG_TAG.search(data):
        raise FormatError(f"{source}: has a tag or comment longer than {MAX_TAG} bytes; save it again")
    parser: Any = DefusedXMLParser(target=target, forbid_dtd=True)
    try:
        for start in range(0, len(data), _PIECE):
            parser.feed(data[start : start + _PIECE])
        return parser.close()
    except (SyntaxError, ValueError, LookupError) as error:
        reason = (str(error).splitlines() or ["no reason given"])[0][:200]
        raise FormatError(f"{source}: the XML is damaged, cut off or not allowed ({reason}); save it again") from None


def local(name: str) -> str:
    """A name without its namespace."""
    return name.rpartition("}")[2]
