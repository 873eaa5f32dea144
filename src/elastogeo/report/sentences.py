"""What a check says, made of its facts: one function per name of a check, in the file `sentences.py` of its wing.

    @says("identifiable")
    def identifiable(facts: Facts, passed: bool | None) -> str:
        return f"All {facts['asked']} parameters are determined by the test."

A new check needs its constant name, its facts and such a function.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

from elastogeo.identification import Check

Facts = Mapping[str, Any]
Sentence = Callable[[Facts, bool | None], str]

_SAID: dict[str, Sentence] = {}


def says(name: str) -> Callable[[Sentence], Sentence]:
    """Register the sentence of the checks of this name."""

    def register(sentence: Sentence) -> Sentence:
        _SAID[name] = sentence
        return sentence

    return register


def sentence_of(check: Check) -> str:
    """The sentence of a check, for a person; a name may say before a colon what the check is of: `X: conditioned`.

    Raises
    ------
    KeyError
        If no wing says anything of checks of this name.
    """
    name = check.name.rpartition(": ")[2]
    for file in _files() if name not in _SAID else ():
        import_module(file)
        if name in _SAID:
            break
    return _SAID[name](check.facts, check.passed)


def _sentences() -> Mapping[str, Sentence]:
    """Those of all wings."""
    for file in _files():
        import_module(file)
    return _SAID


def _files() -> list[str]:
    """The files of sentences; first those of wings that are in use, since their checks are most likely asked for."""
    package = import_module(__name__.rpartition(".")[0])
    wings = [wing.name for wing in iter_modules(package.__path__, f"{package.__name__}.") if wing.ispkg]
    wings.sort(key=lambda wing: wing not in sys.modules)
    return [f"{wing}.sentences" for wing in wings if _has_sentences(import_module(wing).__path__)]


def _has_sentences(folder: Iterable[str]) -> bool:
    return any(file.name == "sentences" for file in iter_modules(folder))
