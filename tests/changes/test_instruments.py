"""One alarm on the instrument where several machines move alike with it, none where they change by themselves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from elastogeo.changes import ChangeVerdict, InstrumentMove, instrument_moves, judge
from tests.changes.simulated_series import MEANS, baseline_of, deviations, series_of

BASELINE, AFTER = 10, 6
CALIBRATED = 20000.0 + 30.0 * BASELINE - 5


def machine(number: int, off: float, seed: int, instrument: str = "bar 7") -> ChangeVerdict:
    """A machine whose stiffness X is off by so many standard deviations from the calibration on."""
    rows = np.zeros((BASELINE + AFTER, 4))
    rows[BASELINE:, 0] = off
    series = series_of(rows, 1000 * seed + number)
    scale = np.array([1 + 0.1 * number, 1.0, 1.0, 1.0])  # machines differ; a gauge shows alike as a share
    series = replace(
        series,
        name=f"machine {number}: circle",
        machine=f"machine {number}",
        instruments=(instrument,) * len(series),
        value=MEANS * scale + (series.value - MEANS) * scale,
    )
    return judge(series, baseline_of(series, BASELINE), now=float(series.date[-1]) + 10)


def moves(*offs: float, seed: int = 0) -> tuple[InstrumentMove, ...]:
    verdicts = [machine(number, off, seed) for number, off in enumerate(offs)]
    return instrument_moves(verdicts, {"bar 7": CALIBRATED})


def test_four_machines_that_a_gauge_shows_softer_alike_are_one_move_of_the_gauge() -> None:
    found = moves(-5, -5, -5, -5)
    assert len(found) == 1
    assert found[0].instrument == "bar 7"
    assert found[0].machines == ("machine 0", "machine 1", "machine 2", "machine 3")
    assert found[0].indicators == ("stiffness X",)
    truth = -5 * deviations()[0] / MEANS[0]
    assert found[0].intervals[0][0] < truth < found[0].intervals[0][1]
    assert found[0].others == ()


def test_two_machines_are_not_enough_nor_are_three_to_different_sides() -> None:
    assert moves(-6, -6) == ()
    assert moves(-6, -6, 6) == ()


def test_machines_that_did_not_move_with_it_speak_against_the_instrument() -> None:
    assert len(moves(-6, -6, -6, 0)) == 1
    assert moves(-6, -6, -6, 0)[0].others == ("machine 3",)
    assert moves(-6, -6, -6, 0, 0) == ()


def test_changes_of_different_size_are_not_one() -> None:
    assert moves(-6, -14, -25) == ()


def test_another_instrument_and_the_time_before_the_calibration_do_not_count() -> None:
    verdicts = [machine(number, -6, 0, "bar 7" if number < 2 else "bar 8") for number in range(4)]
    assert instrument_moves(verdicts, {"bar 7": CALIBRATED, "bar 8": CALIBRATED}) == ()
    alike = [machine(number, -6, 0) for number in range(3)]
    assert instrument_moves(alike, {"bar 7": CALIBRATED + 1000}) == ()
    assert len(instrument_moves(alike)) == 1, "without a calibration every test with it counts"


def test_without_instruments_or_machines_there_is_nothing() -> None:
    assert instrument_moves([]) == ()
    assert instrument_moves([machine(number, -6, 0, "") for number in range(3)]) == ()


def test_both_rates_on_simulated_fleets_of_six() -> None:
    """Wanted: an instrument that is off by 4 sigma on all is found in 95 %; three faults by themselves are no instrument."""
    found = sum(len(moves(-4, -4, -4, -4, -4, -4, seed=seed)) > 0 for seed in range(8))
    assert found == 8
    random = np.random.default_rng(5)
    wrong = 0
    for seed in range(8):
        faults = np.zeros(6)
        faults[:3] = random.uniform(-20, -4, 3)
        wrong += len(moves(*faults, seed=seed)) > 0
    assert wrong == 0


def test_all_series_of_a_machine_that_moved_are_named() -> None:
    verdicts = [machine(number, -6, 0) for number in range(3)]
    second = machine(0, -6, 4)
    other = replace(second.series, name="machine 0: line")
    found = instrument_moves([*verdicts, judge(other, baseline_of(other, BASELINE), now=21000.0)], {"bar 7": CALIBRATED})
    assert found[0].machines == ("machine 0", "machine 1", "machine 2")
    assert sorted(found[0].series) == ["machine 0: circle", "machine 0: line", "machine 1: circle", "machine 2: circle"]


def test_tests_warmer_than_the_baseline_make_the_common_change_less_sure() -> None:
    width = []
    for warmer in (0.0, 4.0):
        verdicts = []
        for number in range(3):
            series = machine(number, -16, 0).series
            warm = 20 + np.where(np.arange(len(series)) < BASELINE, 0.0, warmer) + 0.5 * (-1.0) ** np.arange(len(series))
            series = replace(series, temperature=warm)
            verdicts.append(judge(series, baseline_of(series, BASELINE), now=21000.0))
        low, high = instrument_moves(verdicts, {"bar 7": CALIBRATED})[0].intervals[0]
        width.append(high - low)
    assert width[1] > 1.1 * width[0]
