"""What registers itself is found by importing every file below a folder: instruments, error sources, formats."""

from __future__ import annotations

from importlib import import_module
from pkgutil import walk_packages


def import_all(package: str) -> None:
    """Import every module of a package and of the folders in it.

    Parameters
    ----------
    package : str
        Its dotted name.
    """
    for module in walk_packages(import_module(package).__path__, f"{package}."):
        import_module(module.name)
