"""What a comparison of models says, in words."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from elastogeo.identification import Candidate, ModelChoice
from elastogeo.report.text import UM

_SAID = {
    "constant": "the model as asked",
    "geometry": "the geometry that was not asked for",
    "linear": "compliances that change with the force, each in its own way",
    "linear on the axes": "on-axis compliances that change with the force",
    "contact": "a contact law on each axis",
    "every contact alike": "a contact law, the same share on every axis",
    "every compliance alike": "compliances that all change with the force by the same share",
    "force bend": "a force that bends away from its stated scale",
    "force offset": "an offset of the force",
    "set-up compliance": "a compliance of the set-up",
    "set-up bend": "a compliance of the set-up that changes with the force",
}
SHOWN = 8
"""How many models figures and tables show at least: the one as asked, those that are named with what each is made of, and
those that come nearest."""

_ORDER = ", second order"


def shown_models(models: ModelChoice) -> list[Candidate]:
    """The models that figures and tables show, simpler ones first."""
    named = {"constant", models.supported, *models.alike}
    named |= {part for name in named if name for part in name.split(" and ")}
    others = [model.name for model in models.candidates if model.name not in named]
    named |= set(others[: max(SHOWN - len(named), 0)])
    return sorted((model for model in models.candidates if model.name in named), key=lambda model: model.parameters)


def model_said(name: str) -> str:
    """A model, or what it has besides, in words."""
    if " and " in name:
        return ", and ".join(model_said(part) for part in name.split(" and "))
    if name.endswith(_ORDER):
        return f"{model_said(name.removesuffix(_ORDER))} (quadratic)"
    plain = name.removesuffix("*")
    if plain in _SAID:
        return _SAID[plain]
    if match := re.fullmatch(r"ball form, order (\d+)( \(sine\))?", plain):
        return f"the form of a ball (order {match[1]})"
    if match := re.fullmatch(r"(CF1|H)_(...)", plain):
        return f"C_{match[2]} that changes with the force" if match[1] == "CF1" else f"a contact law at C_{match[2]}"
    return plain


def owners_said(stands_for: Sequence[Sequence[str]]) -> str:
    """What coincides, in words: `E_XX3 or E_YY3 or the form of a ball (order 4)`."""
    return ", and ".join(" or ".join(dict.fromkeys(model_said(name) for name in names)) for names in stands_for)


def supported_said(name: str, stands_for: Sequence[Sequence[str]], exponent: float | None) -> str:
    """A supported model with all that coincides with it, in words."""
    many = len(stands_for) > 2
    words = model_said(name) if many or not stands_for else owners_said(stands_for)
    return words if exponent is None else f"{words} (exponent {exponent:.2f})"


def together_said(added: Mapping[str, Sequence[str]], owners: Mapping[str, Sequence[str]]) -> str:
    """Models that cannot be distinguished: what they share, and what each has besides; empty where they share nothing.

    Parameters
    ----------
    added : mapping of str to sequence of str
        Of each model, by name, the parameters that it has besides.
    owners : mapping of str to sequence of str
        Of each of these, what coincides with it.
    """
    common = [name for name in next(iter(added.values())) if all(name in of for of in added.values())]
    apart = [" and ".join(part for part in name.split(" and ") if part not in common) for name in added]
    if not common or not all(apart):
        return ""
    shared = owners_said([owners[name] for name in common])
    return f"{shared}; and one of these: {'; '.join(_own_said(name, owners) for name in apart)}"


def _own_said(name: str, owners: Mapping[str, Sequence[str]]) -> str:
    return owners_said([owners[name]]) if name in owners else model_said(name)


def left_out_said(error: float | None) -> str:
    """An error at left-out levels."""
    return "an unknown error" if error is None else f"{error * UM:.3g} µm"


def ratio_said(model: Candidate) -> str:
    """By what logarithm a model is better than the one as asked at left-out levels, with its standard uncertainty."""
    if model.log_ratio is None or model.log_ratio_uncertainty is None:
        return "–"
    return f"{model.log_ratio:.2f} ± {model.log_ratio_uncertainty:.2f}"


def models_words(models: ModelChoice) -> list[str]:
    """What decides between models."""
    asked = models.candidates[0]
    words = [
        f"A column is missing from the model as asked with p = {asked.p_value:.2g}: that is how often columns of geometry, "
        f"compliance, force and set-up, tested one by one and combined, would seem as much missing if none was. Runs count "
        f"as independent, readings do not."
    ]
    if models.constant is False and models.supported is not None:
        best = models.of(models.supported)
        words.append(
            f"The data support {supported_said(best.name, best.stands_for, best.exponent)}."
            if best.sufficient
            else f"No model that was tried explains the data; {model_said(best.name)} comes nearest."
        )
        others = [model_said(name) for name in models.alike if name != best.name]
        if others:
            words.append(f"This test cannot distinguish it from: {'; '.join(others)}.")
    if any(candidate.left_out_level is None for candidate in models.candidates):
        words.append("Where an error at left-out runs or levels is missing, the others do not determine that model.")
    return words
