"""What a check says, made of its facts: one function per name of a check, in the file `sentences.py` of its wing.

    @says("identifiable")
    def identifiable(facts: Facts, passed: bool | None) -> str:
        return f"All {facts['asked']} parameters are determined by the test."

A new check needs its constant name, its facts and such a function.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
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
    return _sentences()[check.name.rpartition(": ")[2]](check.facts, check.passed)


def _sentences() -> Mapping[str, Sentence]:
    package = import_module(__name__.rpartition(".")[0])
    for wing in iter_modules(package.__path__, f"{package.__name__}."):
        if wing.ispkg and any(file.name == "sentences" for file in iter_modules(import_module(wing.name).__path__)):
            import_module(f"{wing.name}.sentences")
    return _SAID
