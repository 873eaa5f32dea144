"""Which tests compare: what makes a recipe, and what does not."""

from dataclasses import replace

import numpy as np
import pytest

from elastogeo.formats import read_test
from elastogeo.history.intake.recipes import alike, differing, recipe_of
from elastogeo.observe import Calibration, Expansion, KnownInfluence, instruments
from tests.history.intake.small_tests import write_test


@pytest.fixture
def plain(tmp_path):
    return read_test(write_test(tmp_path / "plain"))


def test_names_days_numbers_and_readings_are_not_in_it(plain, tmp_path):
    other = write_test(
        tmp_path / "other", name="April", date="2026-04-01", seed=7, instrument_serial="B7", machine_serial="4711",
        operator="A. Nobody", remarks="warm",
    )  # fmt: skip
    assert recipe_of(read_test(other)) == recipe_of(plain)


def test_calibration_temperature_and_known_influences_are_not_in_it(plain):
    known = replace(plain, influences=(KnownInfluence("force-scale", relative=0.01),), resolution=1e-4)
    gauge = Calibration((1.0, 6.0), (112.0, 742.0))
    by = [replace(plain.setup, calibration=replace(gauge, relative=relative)) for relative in (0.01, 0.02)]
    warm = [replace(plain.setup, machine_at=Expansion(degrees, 11.5e-6)) for degrees in (19.0, 26.5)]
    assert recipe_of(known) == recipe_of(plain)
    assert recipe_of(replace(plain, setup=by[0])) == recipe_of(replace(plain, setup=by[1]))
    assert recipe_of(replace(plain, setup=warm[0])) == recipe_of(replace(plain, setup=warm[1]))
    assert differing(recipe_of(plain).document, recipe_of(replace(plain, setup=warm[0])).document) == ("corrections",)


def test_another_spelling_of_a_setting_is_the_same(plain, tmp_path):
    folder = write_test(tmp_path / "other")
    text = (folder / "test.toml").read_text()
    text = text.replace("radius_mm = 150", "radius_m = 0.15").replace("feed_mm_min = 2000", "feed_m_min = 2")
    assert "0.15" in text
    (folder / "test.toml").write_text(text)
    assert recipe_of(read_test(folder)) == recipe_of(plain)


def test_the_order_of_the_runs_does_not_count(plain):
    assert recipe_of(replace(plain, runs=plain.runs[::-1])) == recipe_of(plain)


@pytest.mark.parametrize(
    ("changed", "where"),
    [
        ({"forces": (36.0, 490.0)}, "runs.level"),
        ({"forces": (36.0, 490.0, 742.0)}, "runs"),
        ({"feed": 1000}, "setup.feed"),
        ({"radius": 100}, "setup.circle.radius"),
        ({"machine": "huron_kx8"}, "topology"),
    ],
)
def test_what_was_done_otherwise_is_named(changed, where, plain, tmp_path):
    other = recipe_of(read_test(write_test(tmp_path / "other", **changed)))
    assert other.sha256 != recipe_of(plain).sha256
    assert differing(recipe_of(plain).document, other.document) == (where,)


def test_sense_repeats_arc_and_question_count(plain):
    one, two = plain.runs
    half = {name: column[: len(column) // 2] for name, column in one.columns.items()}
    others = {
        "sense": replace(plain, runs=(replace(one, sense=-1), two)),
        "runs": replace(plain, runs=(one, replace(one, name="again", repeat=2), two)),
        "arc_deg": replace(plain, runs=(replace(one, columns=half), two)),
        "reciprocal": replace(plain, question=replace(plain.question, reciprocal=True)),
    }
    for where, test in others.items():
        (found,) = differing(recipe_of(plain).document, recipe_of(test).document)
        assert where in found


def test_a_force_that_was_read_off_is_the_level(plain):
    near = recipe_of(replace(plain, runs=tuple(replace(run, force=1.012 * run.force) for run in plain.runs)))
    far = recipe_of(replace(plain, runs=tuple(replace(run, force=1.05 * run.force) for run in plain.runs)))
    assert near.sha256 != recipe_of(plain).sha256
    assert alike(near.document, recipe_of(plain).document)
    assert not alike(far.document, recipe_of(plain).document)


def test_repeats_of_a_level_are_one_however_they_were_read_off(plain):
    one, two = plain.runs
    jittered = [replace(plain, runs=(one, replace(one, name="b", force=36 + off), two)) for off in (0.3, -0.2)]
    first, second = (recipe_of(test).document for test in jittered)
    assert [run["runs"] for run in first["runs"]] == [2, 1]
    assert alike(first, second)


def test_simulated_and_measured_never_compare(plain):
    made = recipe_of(replace(plain, simulated="tables"))
    assert differing(made.document, recipe_of(plain).document) == ("origin",)
    assert made.name == "loaded ball bar XY R150 36 to 742 N, simulated"


@pytest.mark.parametrize("name", sorted(instruments()))
def test_every_instrument_says_what_is_knowledge(name):
    kind = instruments()[name]
    known = set(kind.__dataclass_fields__)
    assert set(kind.knowledge) <= known
    assert set(kind.corrections) <= set(kind.knowledge)
    assert {kind.warm} <= {"", *known}
    told = {
        field.name
        for field in kind.__dataclass_fields__.values()
        if "Calibration" in str(field.type) or "Expansion" in str(field.type)
    }
    assert told <= set(kind.knowledge)


def test_temperature_of_a_run_is_not_a_setting(plain):
    warm = replace(plain.setup, machine_at=Expansion(22.0, 11.5e-6))
    tests = [
        replace(plain, setup=warm, runs=tuple(replace(run, machine_temperature=t) for run in plain.runs))
        for t in (21.0, 24.0)
    ]
    assert recipe_of(tests[0]) == recipe_of(tests[1])


def test_a_setting_that_is_no_number_is_written(plain):
    far = replace(plain.setup, setup_deflection=0.0, setup_deflection_degrees_of_freedom=np.inf)
    assert recipe_of(replace(plain, setup=far)) == recipe_of(plain)
