"""What a comparison of models found."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.identification.model_choice.following import OffLevel

CONSTANT = "constant"


@dataclass(frozen=True, slots=True)
class Candidate:
    """One model.

    Attributes
    ----------
    name : str
        `constant` for the one that was asked; else what it has besides.
    places : tuple of str
        Where that lives: `geometry`, `compliance`, `force`, `set-up`; several where columns of several coincide.
    added : tuple of str
        The parameters it has besides.
    stands_for : tuple of tuple of str
        For each of these, the parameters whose columns coincide with it beyond the model: no test of this kind can tell them
        from one another.
    values : tuple of float
        Estimates of the added parameters, in units of their columns.
    exponent : float or None
        Of a contact law, if it was searched.
    parameters : int
        How many, an exponent included.
    rmse : float [mm or rad]
        Over all readings.
    left_out_run, left_out_level : float or None [mm or rad]
        RMSE of the readings of a run, of a force level, predicted from all others; None if these do not determine the model.
    level_errors : tuple of float [mm or rad]
        RMSE of each level, predicted from all others, in the order of the levels.
    log_ratio, log_ratio_uncertainty : float or None
        Mean over the levels of the logarithm of left-out error of `constant` over its own, and its standard uncertainty.
    p_value : float
        Probability, if this model is true, that some column that it lacks seems to be missing by as much.
    sufficient : bool
        Whether nothing that was offered is missing from it.
    """

    name: str
    places: tuple[str, ...]
    added: tuple[str, ...]
    stands_for: tuple[tuple[str, ...], ...]
    values: tuple[float, ...]
    exponent: float | None
    parameters: int
    rmse: float
    left_out_run: float | None
    left_out_level: float | None
    level_errors: tuple[float, ...]
    log_ratio: float | None
    log_ratio_uncertainty: float | None
    p_value: float
    sufficient: bool


@dataclass(frozen=True, slots=True)
class ModelChoice:
    """The models of one test, and what its data support.

    Attributes
    ----------
    candidates : tuple of Candidate
        `constant` first; alone if nothing is missing from it.
    supported : str or None
        The simplest sufficient one; if none is, the one that predicts left-out levels best. None if nothing could be tested.
    alike : tuple of str
        The sufficient ones, the supported among them, of which none holds another: **this test cannot distinguish them.**
    off_level : OffLevel or None
        A force level that does not follow the others under the supported model.
    tested : tuple of str
        Parameters whose absence would have been seen.
    unseen : tuple of str
        Parameters that this test cannot distinguish from those of the model, or has too few levels for.
    levels, runs : int
    """

    candidates: tuple[Candidate, ...]
    supported: str | None
    alike: tuple[str, ...]
    off_level: OffLevel | None
    tested: tuple[str, ...]
    unseen: tuple[str, ...]
    levels: int
    runs: int

    def of(self, name: str) -> Candidate:
        """A candidate by its name."""
        return next(candidate for candidate in self.candidates if candidate.name == name)

    @property
    def constant(self) -> bool | None:
        """Whether the model that was asked is supported; None if nothing could be tested."""
        return None if self.supported is None else self.supported == CONSTANT

    @property
    def explained(self) -> bool:
        """Whether the supported model lacks nothing that was offered."""
        return self.supported is not None and self.of(self.supported).sufficient

    @property
    def places(self) -> tuple[str, ...]:
        """Where what is missing may live: the places of all models that cannot be distinguished, each once."""
        chosen = self.alike or ((self.supported,) if self.supported else ())
        return tuple(dict.fromkeys(place for name in chosen for place in self.of(name).places))
