"""What the checks of a feed drive say."""

from __future__ import annotations

from elastogeo.report.sentences import Facts, says


@says("terms distinguished")
def terms_distinguished(facts: Facts, passed: bool | None) -> str:
    """Whether each term of the balance has a number of its own."""
    if passed:
        return f"All {facts['terms']} parameters are determined by the records."
    return _sentence(facts["reason"])


@says("physically possible")
def physically_possible(facts: Facts, passed: bool | None) -> str:
    """Whether a friction or an inertia is negative."""
    if passed:
        return "No inertia and no friction is negative beyond its uncertainty."
    return (
        f"{', '.join(facts['below'])} is negative, and its interval excludes zero. No drive moves by its own friction or "
        f"inertia: check the sign of the effort, or the terms of the model."
    )


@says("runs repeated")
def runs_repeated(facts: Facts, passed: bool | None) -> str:
    """What the uncertainties take as independent."""
    if passed:
        return f"The uncertainties come from the scatter of {facts['runs']} runs."
    if facts["counted"] == "pieces":
        return (
            f"{facts['runs']} runs are too few, so the uncertainties come from the scatter of their pieces: "
            f"what is common to "
            f"a run, such as its temperature, is not in them. Repeat the runs."
        )
    return (
        "The uncertainties take every sample as independent, which neighbours in a log are not: they are too small. Record "
        "more runs, or longer ones."
    )


@says("standstill left out")
def standstill_left_out(facts: Facts, passed: bool | None) -> str:
    """How much of the records is at rest, and whether leaving it out is right."""
    share, unit = f"{100 * facts['share']:.2g} %", facts["effort_unit"]
    if not facts["share"]:
        return "No record shows a standstill."
    judged = ""
    if facts["kept"] is not None:
        judged = (
            f" Moving samples of left-out runs are predicted to {facts['left_out']:.3g} {unit} without them, to "
            f"{facts['kept']:.3g} {unit} with them."
        )
    if passed:
        stated = facts["stated_speed"]
        slower = f"{facts['speed']:.2g}" if stated is None else f"{stated:g}"
        why = "the noise at rest" if stated is None else "the least speed stated"
        return (
            f"{share} of the samples are at standstill and were left out, and so are motions slower than {slower} "
            f"{facts['length_unit']}/s, {why}.{judged}"
        )
    if facts["worse"]:
        return f"{share} of the samples look like standstill, but predict the others.{judged} State least_speed yourself."
    return (
        f"{share} of the samples are at standstill, where friction has no known direction; they are "
        f"{100 * facts['used']:.2g} "
        f"% of those used.{judged} Raise least_speed, or leave it out of the drive file."
    )


@says("held-out runs predicted")
def held_out_predicted(facts: Facts, passed: bool | None) -> str:
    """How well the shown model predicts the held-out runs."""
    if passed is None:
        return "Not tested: no sample of the held-out runs can be used; they do not move. Hold out runs that move."
    unit = facts["effort_unit"]
    return (
        f"{facts['runs']} held-out runs are predicted to {facts['held_out']:.3g} {unit} (RMSE), those identified from to "
        f"{facts['identified']:.3g} {unit}{'' if passed else ': the drive or its load was another'}."
    )


@says("friction model adequate")
def friction_model_adequate(facts: Facts, passed: bool | None) -> str:
    """Whether the shown model is the one that the runs support."""
    if passed is None:
        return f"Not tested: {facts['reason']}. The model {facts['shown']} is shown and was compared with none."
    unit, first, best = facts["effort_unit"], facts["first"], facts["supported"]
    gain = (
        f"it predicts left-out runs to {facts['supported_rmse']:.4g} {unit}, the {first} model to {facts['first_rmse']:.4g} "
        f"({100 * facts['gain']:.1f} % less)"
    )
    if not passed:
        return (
            f"The runs support the model {best}, not {facts['shown']}, which was asked for: {gain}. Ask for it with --model "
            f'"{best}".'
        )
    if best != first:
        return f"The runs support the model {best}: {gain}. Its parameters are shown."
    return (
        f"The {first} model predicts left-out runs to {facts['first_rmse']:.4g} {unit}; no richer one "
        f"does so surely better, "
        f"by a gain worth having (the best, {facts['least']}, to {facts['least_rmse']:.4g})."
    )


@says("time shift distinct from averaging")
def shift_distinct(facts: Facts, passed: bool | None) -> str:
    """Whether a delay does more than an average of neighbouring samples."""
    verdict = "so the shift is real" if passed else "so no delay between the channels is shown"
    return (
        f"A shift of {1000 * facts['delay_s']:.3g} ms predicts left-out runs to {facts['shift_rmse']:.4g} "
        f"{facts['effort_unit']}, an average of neighbouring samples without a shift to "
        f"{facts['averaged_rmse']:.4g}: {verdict}."
    )


@says("residuals like noise")
def residuals_like_noise(facts: Facts, passed: bool | None) -> str:
    """What structure the residuals have left."""
    unit = facts["effort_unit"]
    if passed:
        return f"The residuals look like noise; RMS {facts['rms']:.3g} {unit}."
    parts = []
    if facts["correlated"]:
        apart = f"{facts['apart_s'] * 1000:.3g} ms apart"
        parts.append(f"residuals {apart} correlate by {facts['autocorrelation']:.2f} (noise: below {facts['limit']:.2f})")
    if facts["biased"]:
        forward, backward = (facts[name] or 0.0 for name in ("forward", "backward"))
        parts.append(f"their mean is {forward:.2g} {unit} forward and {backward:.2g} {unit} backward")
    if facts["uneven"]:
        parts.append("they are far greater at one speed than at another")
    return (
        f"{_sentence(', and '.join(parts))[:-1]}; RMS {facts['rms']:.3g} {unit}, {facts['slow']:.3g} in the slower half and "
        f"{facts['fast']:.3g} in the faster. The model lacks something: a load, a position, a law of friction, a shift."
    )


@says("direction known")
def direction_known(facts: Facts, passed: bool | None) -> str:
    """How many signs of the velocity noise decides."""
    advice = "" if passed else " Raise least_speed, lower the cut-off, or take a smooth sign."
    return f"{100 * facts['share']:.2g} % of the samples have another direction than both their neighbours.{advice}"


@says("sampled fast enough")
def sampled_fast_enough(facts: Facts, passed: bool | None) -> str:
    """Whether the acceleration explains the change of the velocity."""
    advice = (
        ""
        if passed
        else ": accelerations begin and end between two samples, so inertia and time shift rest on few chance samples. "
        "Record faster"
    )
    return (
        f"At {facts['step_s'] * 1000:.3g} ms a sample, the acceleration explains "
        f"{100 * facts['share']:.0f} % of the change of "
        f"the velocity from sample to sample{advice}."
    )


@says("effort resolved")
def effort_resolved(facts: Facts, passed: bool | None) -> str:
    """Whether rounding of the effort matters."""
    if facts["digits"] is None:
        return "The effort is written with enough digits."
    unit = facts["effort_unit"]
    return (
        f"The effort is written with {facts['digits']} significant digits, which rounds it by up to {facts['rounding']:.2g} "
        f"{unit}: {'little' if passed else 'much'} against the RMS residual of {facts['rms']:.3g} {unit}."
    )


def _sentence(text: str) -> str:
    """A sentence from the words of an error."""
    return f"{text[:1].upper()}{text[1:]}." if text else text
