"""A sphere nest on three kinds of five-axis machines: what it tells of location errors, against a second derivation.

The derivation below shares nothing with the program: products of 4 x 4 transforms, commands solved from them, derivatives by
central differences, the null space by singular values. What is known alone is what no null vector touches.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy import stats

from elastogeo.identification import explain, identify
from elastogeo.machine import Array, Joint, Machine, parse_topology
from elastogeo.observe import Imperfection, KnownInfluence, MachineTest, Question, Run, SphereNest
from elastogeo.report import view_of
from elastogeo.sources import simulate

SENSORS = ((1.0, 0.0, 1.0), (-0.5, 0.9, 1.0), (-0.4, -0.8, 1.2))
SET_UPS = {"both known": "", "sphere free": "w", "tool point free": "t", "both free": "wt"}


@dataclass(frozen=True)
class Kind:
    """A kind of machine: branches from the foundation outwards, offsets of each joint, the ends' points, what is asked."""

    workpiece: str
    tool: str
    rotary: tuple[str, ...]
    squareness: tuple[str, ...]
    swing: dict[str, tuple[float, float]]
    uncarried: str = ""

    @property
    def topology(self) -> str:
        return f"w{self.workpiece[::-1]}F{self.tool}t"

    def offset(self, axis: str) -> Array:
        return np.random.default_rng(ord(axis)).uniform(-120, 120, 3)

    @property
    def tool_point(self) -> Array:
        return np.array([15.0, -10.0, -190.0])

    @property
    def centre(self) -> dict[str, float]:
        return {"X": 90.0, "Y": -60.0, "Z": 40.0}

    @property
    def commands(self) -> list[dict[str, float]]:
        """Each rotary axis alone, then both: rotary commands only."""
        part = np.linspace(0, 1, 9)
        one, two = ({axis: low + (high - low) * part for axis, (low, high) in [swing]} for swing in self.swing.items())
        (a, qa), (b, qb) = next(iter(one.items())), next(iter(two.items()))
        rows = [{a: q, b: 0.0} for q in qa] + [{a: 0.0, b: q} for q in qb]
        return rows + [{a: q, b: r} for q, r in zip(qa, qb[::-1], strict=True)] + [{a: q, b: r} for q in qa[::4] for r in qb]

    def test(self, free: str = "", squareness: bool = False, repeats: int = 1) -> MachineTest:
        joints = {axis: Joint(axis, offset=tuple(self.offset(axis))) for axis in self.workpiece + self.tool}
        topology = parse_topology(self.topology)
        machine = Machine(self.topology, topology, tuple(joints[a] for a in topology.axes), tool=tuple(self.tool_point))
        known = tuple(end for end, letter in (("tool", "t"), ("workpiece", "w")) if letter not in free)
        setup = SphereNest(SENSORS, self.centre, "workpiece", known)
        columns = {axis.lower(): np.array([row[axis] for row in self.commands]) for axis in self.swing}
        columns |= {f"displacement_{k}": np.zeros(len(self.commands)) for k in (1, 2, 3)}
        runs = tuple(Run(str(k), columns, repeat=k) for k in range(1, repeats + 1))
        asked = (*setup.default_parameters(()), *self.squareness) if squareness else ()
        return MachineTest(self.topology, machine, setup, runs, Question(asked))


TABLE_TABLE = Kind(
    "AC",
    "YXZ",
    ("E_Y(0)A", "E_Z(0)A", "E_B(0)A", "E_C(0)A", "E_X(0A)C", "E_Y(0A)C", "E_A(0A)C", "E_B(0A)C"),
    ("E_C(0Y)X", "E_A(0X)Z", "E_B(0X)Z"),
    {"A": (-1.2, 1.1), "C": (0.0, 5.8)},
    "t",
)
HEAD_TABLE = Kind(
    "YC",
    "XZB",
    ("E_X(0Y)C", "E_Y(0Y)C", "E_A(0Y)C", "E_B(0Y)C", "E_X(0Z)B", "E_Z(0Z)B", "E_A(0Z)B", "E_C(0Z)B"),
    ("E_C(0)Y", "E_A(0X)Z", "E_B(0X)Z"),
    {"B": (-1.0, 1.2), "C": (0.0, 5.8)},
)
HEAD_HEAD = Kind(
    "",
    "XYZCA",
    ("E_X(0Z)C", "E_Y(0Z)C", "E_A(0Z)C", "E_B(0Z)C", "E_Y(0C)A", "E_Z(0C)A", "E_B(0C)A", "E_C(0C)A"),
    ("E_C(0X)Y", "E_A(0Y)Z", "E_B(0Y)Z"),
    {"A": (-1.1, 1.3), "C": (0.0, 5.8)},
    "w",
)
KINDS = {"table-table": TABLE_TABLE, "head-table": HEAD_TABLE, "head-head": HEAD_HEAD}


def transform(direction: int, value: float) -> Array:
    """A motion along (0 to 2) or about (3 to 5) an axis, as a 4 x 4 matrix."""
    T = np.eye(4)
    if direction < 3:
        T[direction, 3] = value
    else:
        i, j = {3: (1, 2), 4: (2, 0), 5: (0, 1)}[direction]
        T[i, i] = T[j, j] = np.cos(value)
        T[j, i], T[i, j] = np.sin(value), -np.sin(value)
    return T


def end_point(kind: Kind, branch: str, side: float, commands: dict[str, float], point: Array, errors: dict) -> Array:
    place = np.eye(4)
    for axis in branch:
        link = np.eye(4)
        link[:3, 3] = kind.offset(axis)
        place = place @ link
        for component, value in errors.get(axis, {}).items():
            place = place @ transform("XYZABC".index(component), value)
        place = place @ transform("XYZABC".index(axis), side * commands.get(axis, 0.0))
    return (place @ [*point, 1.0])[:3]


def apart(kind: Kind, commands: dict[str, float], ball: Array, errors: dict) -> Array:
    """From the ball on the workpiece side to the tool point, in the foundation."""
    tool = end_point(kind, kind.tool, 1.0, commands, kind.tool_point + errors.get("t", 0.0), errors)
    return tool - end_point(kind, kind.workpiece, -1.0, commands, ball + errors.get("w", 0.0), errors)


def errors_of(name: str, value: float) -> dict:
    if name[-1] == "0":
        return {name[3]: value * (np.array(list("XYZ")) == name[2])}
    return {name[-1]: {name[2]: value}}


def derived(kind: Kind, names: list[str]) -> tuple[int, set[str]]:
    """Rank, and what is known alone, of parameters by name."""
    corner = end_point(kind, kind.tool, 1.0, kind.centre, kind.tool_point, {})
    # no rotary axis is turned at the centre: the ball's place on the workpiece side is a difference of points
    ball = corner - end_point(kind, kind.workpiece, -1.0, kind.centre, np.zeros(3), {})
    rows = []
    for rotary in kind.commands:
        # along its axis each linear command moves the tool relative to the workpiece by itself, on either branch
        missed = apart(kind, rotary, ball, {})
        place = {**rotary, **dict(zip("XYZ", -missed, strict=True))}
        assert np.abs(apart(kind, place, ball, {})).max() < 1e-9
        steps = [1.0 if name[2] in "XYZ" else 1e-3 for name in names]
        columns = [
            (apart(kind, place, ball, errors_of(n, h)) - apart(kind, place, ball, errors_of(n, -h))) / (2 * h)
            for n, h in zip(names, steps, strict=True)
        ]
        rows.append(np.column_stack(columns))
    design = np.vstack(rows)
    design /= np.linalg.norm(design, axis=0)
    _, s, Vt = np.linalg.svd(design)
    rank = int(np.sum(s > 1e-4 * s[0]))
    assert rank == len(s) or s[rank] < 1e-6 * s[rank - 1]
    touched = np.abs(Vt[rank:]).max(axis=0, initial=0.0)
    assert not np.any((touched > 1e-5) & (touched < 1e-3))
    return rank, {name for name, size in zip(names, touched, strict=True) if size < 1e-5}


@pytest.mark.parametrize("squareness", [False, True], ids=["squareness known", "squareness asked"])
@pytest.mark.parametrize("set_up", SET_UPS)
@pytest.mark.parametrize("kind", KINDS)
def test_rank_and_what_is_known_alone_are_those_of_a_second_derivation(kind: str, set_up: str, squareness: bool) -> None:
    machine, free = KINDS[kind], SET_UPS[set_up]
    found = explain(machine.test(free, squareness)).confounding
    names = [*machine.rotary, *(f"E_{c}{end}0" for end in free for c in "XYZ"), *(machine.squareness if squareness else ())]
    assert set(found.labels) == set(names)
    rank, alone = derived(machine, names)
    print(kind, set_up, squareness, rank, len(names), sorted(set(names) - alone))
    assert found.rank == rank
    assert {name for name in found.retained if len(found.stands_for(name)) == 1} == alone


def by_hand(kind: str, set_up: str) -> set[str]:
    """What moves the ball by a constant vector, and so cannot be told from an offset that moves it alike (issue 9, 7)."""
    positions = {"table-table": {"E_Y(0)A", "E_Z(0)A", "E_X(0A)C"}, "head-head": {"E_X(0Z)C", "E_Y(0Z)C", "E_Z(0C)A"}}
    uncarried = KINDS[kind].uncarried
    return {*positions[kind], *(f"E_{c}{uncarried}0" for c in "XYZ")} if uncarried in SET_UPS[set_up] else set()


@pytest.mark.parametrize("set_up", SET_UPS)
@pytest.mark.parametrize("kind", ["table-table", "head-head"])
def test_an_end_that_no_rotary_axis_carries_hides_three_positions(kind: str, set_up: str) -> None:
    found = explain(KINDS[kind].test(SET_UPS[set_up])).confounding
    sums = {name for label in found.retained if len(terms := found.stands_for(label)) > 1 for name in terms}
    assert sums == by_hand(kind, set_up)


def test_a_head_and_a_table_show_the_distance_of_their_axes_only() -> None:
    """C moved by +x takes the ball along, B moved by +x the tool: the reading has the difference."""
    found = explain(HEAD_TABLE.test()).confounding
    assert found.rank == 7
    assert found.stands_for("E_X(0Z)B") == pytest.approx({"E_X(0Z)B": 1.0, "E_X(0Y)C": -1.0})


def test_the_sum_is_said_by_name() -> None:
    truth = {"E_X(0Y)C": 0.02, "E_X(0Z)B": 0.005}
    result = identify(simulate(HEAD_TABLE.test(repeats=3), truth, Imperfection(noise=1e-5), seed=3))
    assert result["E_X(0Z)B"].value == pytest.approx(-0.015, abs=1e-5)
    assert "E_X(0Z)B stands for E_X(0Z)B - E_X(0Y)C" in view_of(result).notes


@pytest.mark.parametrize("kind", ["table-table", "head-head"])
def test_eight_location_errors_lie_within_their_intervals(kind: str) -> None:
    """The end that no rotary axis carries known, the other free, squareness known; over many draws at the stated rate."""
    machine = KINDS[kind]
    free = "wt".replace(machine.uncarried, "")
    blank = machine.test(free, repeats=4)
    random = np.random.default_rng(7)
    inside, draws = np.zeros(8), 30
    for seed in range(draws):
        truth = {name: random.normal() * (0.02 if name[2] in "XYZ" else 5e-5) for name in machine.rotary}
        truth |= {f"E_{c}{free}0": random.normal() * 0.03 for c in "XYZ"}
        result = identify(simulate(blank, truth, Imperfection(noise=5e-4), seed=seed, exact=False))
        assert result.confounding.rank == len(result.parameters) == 11
        intervals = [result[name].interval for name in machine.rotary]
        inside += [low <= truth[name] <= high for name, (low, high) in zip(machine.rotary, intervals, strict=True)]
    low, high = stats.binom.ppf([0.001 / 16, 1 - 0.001 / 16], draws, 0.95)
    print(kind, inside)
    assert np.all((low <= inside) & (inside <= high))
    assert low > 20


def test_the_exact_machine_gives_its_location_errors_back() -> None:
    """By exact products of transforms: what the first order leaves out is nanometres."""
    truth = dict(zip(TABLE_TABLE.rotary, (0.012, -0.008, 3e-5, -2e-5, 0.015, -0.01, 2e-5, 4e-5), strict=True))
    truth |= {"E_Xw0": 0.02, "E_Yw0": -0.03, "E_Zw0": 0.01}
    result = identify(simulate(TABLE_TABLE.test("w", repeats=2), truth, exact=True))
    for name, value in truth.items():
        assert result[name].value == pytest.approx(value, abs=2e-6 if name[2] in "XYZ" else 5e-8), name


ERROR_MOTIONS = ("rotary-axes", "E_[XYZ]w0", "E_[XYZAB]C[cs]2")


def test_a_second_place_of_the_ball_tells_radial_from_tilt_error_motions() -> None:
    """By hand: a ball h above the origin of C goes as far in x for a tilt of 1 about y as for a radial error of h."""
    low = TABLE_TABLE.test("w", repeats=3)
    high = replace(low, setup=replace(low.setup, centre={"X": -70.0, "Y": 100.0, "Z": 170.0}))
    height = (
        40.0
        + TABLE_TABLE.tool_point[2]
        + sum(TABLE_TABLE.offset(axis)[2] * (1 if axis in "XYZ" else -1) for axis in "XYZAC")
    )
    alone = explain(low, parameters=ERROR_MOTIONS).confounding
    assert alone.stands_for("E_XCc2") == pytest.approx({"E_XCc2": 1.0, "E_BCc2": height})
    truth = {"E_XCc2": 0.004, "E_BCc2": 2e-5, "E_X(0A)C": 0.01}
    tests = {
        name: simulate(test, truth, Imperfection(noise=3e-4), seed)
        for seed, (name, test) in enumerate(zip(("low", "high"), (low, high), strict=True))
    }
    both = identify(tests, parameters=ERROR_MOTIONS)
    assert both.confounding.rank == len(both.confounding.labels) == 8 + 6 + 10
    for name, value in truth.items():
        low_end, high_end = both[name].interval
        assert low_end <= value <= high_end, name


def test_what_is_known_of_an_end_is_in_the_budget() -> None:
    """A tool point that may be 3 um off in each direction puts these 3 um on every position that it cannot be told from."""
    blank = TABLE_TABLE.test("w", repeats=4)
    known = KnownInfluence("tool-offset", "run-out of the ball", length=0.003)
    plain, stated = (
        identify(simulate(replace(blank, influences=influences), {"E_Y(0)A": 0.01}, Imperfection(noise=1e-4), seed=2))
        for influences in ((), (known,))
    )
    for name in ("E_Y(0)A", "E_Z(0)A", "E_X(0A)C"):
        added = stated[name].standard_uncertainty ** 2 - plain[name].standard_uncertainty ** 2
        assert np.sqrt(added) == pytest.approx(0.003, rel=1e-3), name
    for name in ("E_B(0)A", "E_A(0A)C"):
        assert stated[name].standard_uncertainty == pytest.approx(plain[name].standard_uncertainty, rel=1e-6), name
