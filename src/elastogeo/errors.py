"""The one exception tree of elastogeo.

Every error says what arrived, where, why it is refused, and what to do about it. Two branches matter to a caller:
`InputError` (the input is wrong: exit code 2) and `UnsupportedError` (the input is sound but the data do not support
the question: exit code 1).
"""

from collections.abc import Sequence

NAMED = 8
"""Names that a message lists before it counts the others."""


def several(names: Sequence[str]) -> str:
    """Names for a message: all of a few, the first of many with the count of the others."""
    if len(names) <= NAMED + 1:
        return ", ".join(names)
    return f"{', '.join(names[:NAMED])} and {len(names) - NAMED} more"


class ElastogeoError(Exception):
    """Root of all errors that elastogeo raises on purpose."""


class InputError(ElastogeoError):
    """Something that was given is wrong: a file, a name, a unit, a shape."""


class MachineError(InputError):
    """A machine description contradicts itself or cannot be built."""


class PathError(InputError):
    """The machine cannot make the commanded path."""


class FormatError(InputError):
    """A file cannot be read as what it claims to be."""


class SelectionError(InputError):
    """A name or pattern selects nothing, or nothing that exists."""


class DeliveryError(ElastogeoError):
    """A message could not be delivered; `lasting` if trying again cannot help."""

    def __init__(self, message: str, lasting: bool = False) -> None:
        super().__init__(message)
        self.lasting = lasting


class StoreError(InputError):
    """The history cannot be opened, read or written."""


class UnsupportedError(ElastogeoError):
    """The data do not support what was asked of them."""


class RankError(UnsupportedError):
    """The design cannot tell the parameters apart that were asked for."""


class DegreesOfFreedomError(UnsupportedError):
    """There are not enough readings, runs or levels for the uncertainty that was asked for."""
