"""What is imported when: a name of a face when it is used first; all that registers itself when the register is asked."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from pkgutil import walk_packages
from typing import Any


def import_all(package: str) -> None:
    """Import every module of a package and of the folders in it.

    Parameters
    ----------
    package : str
        Its dotted name.
    """
    for module in walk_packages(import_module(package).__path__, f"{package}."):
        import_module(module.name)


def first_use(face: str, homes: Mapping[str, str]) -> Callable[[str], Any]:
    """The `__getattr__` of a face whose names are imported when they are used first (PEP 562).

    A command needs few of the files of a room, and each costs its share of a second before the first number.

    Parameters
    ----------
    face : str
        Dotted name of the package.
    homes : mapping of str to str
        By module, its dotted name below the package, the names that are found there, with blanks between. No module has
        the name of one of them: once it is imported, the package would have the module in its place.
    """
    home = {name: f"{face}.{module}" for module, names in homes.items() for name in names.split()}

    def found(name: str) -> Any:
        if name not in home:
            raise AttributeError(f"{face} has no {name!r}; it has {', '.join(sorted(home, key=str.lower))}")
        value = getattr(import_module(home[name]), name)
        setattr(sys.modules[face], name, value)
        return value

    return found
