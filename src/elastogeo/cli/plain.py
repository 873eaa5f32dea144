"""A text for a terminal, without what commands the terminal: somebody else may have written it, on a page or in a file."""

from __future__ import annotations

_DIRECTION = (*range(0x202A, 0x202F), *range(0x2066, 0x206A))
_CONTROL = [code for code in (*range(0x20), *range(0x7F, 0xA0), *_DIRECTION) if chr(code) not in "\n\t"]
_REPLACED = dict.fromkeys(_CONTROL, "\N{REPLACEMENT CHARACTER}")


def plain(text: str) -> str:
    """The text, a sign in the place of each control character but line ends and tabs.

    An escape sequence could rename the window, overwrite what stands above, or type what the next command reads.
    """
    return text.translate(_REPLACED)
