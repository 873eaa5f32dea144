"""Ceilings of the rank: the totals of `reference/planning.md`, and six-component tests by brute force.

Those totals were derived twice, by SVD over random poses and by exact elimination modulo a prime, by another program.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from elastogeo.errors import InputError, MachineError
from elastogeo.machine import Array, Frame, Joint, Machine, Place, jacobian, parse_topology, rotation_matrix
from elastogeo.planning import ceiling
from elastogeo.planning.invariants import generator, invariants

Points = dict[str, tuple[float, float, float]]


def machine_of(
    topology: str, offset: Points | None = None, tilt: Points | None = None, rigid: str = "S", places: tuple[Place, ...] = ()
) -> Machine:
    """A machine whose frames coincide at rest but for what is given."""
    parsed = parse_topology(topology)
    zero = (0.0, 0.0, 0.0)
    joints = tuple(
        Joint(a, offset=(offset or {}).get(a, zero), tilt=(tilt or {}).get(a, zero), compliant=a not in rigid)
        for a in parsed.axes
    )
    return Machine(topology, parsed, joints, places=places)


def six_component_rows(machine: Machine, poses: int = 12, held: dict[str, float] | None = None) -> Array:
    """Rows of all six loads and six readings at random poses, by the Jacobian: columns joint by joint, then d, then f.

    Commands within 1.5 mm and rad, so that no lever makes the cut less clear.
    """
    random = np.random.default_rng(1)
    commands = random.uniform(-1.5, 1.5, (poses, len(machine.axes)))
    for axis, command in (held or {}).items():
        commands[:, machine.index(axis)] = command
    J = jacobian(machine, commands)
    blocks = []
    for joint in machine.compliant:
        k = 6 * machine.index(joint.name)
        of_joint = J[:, :, k : k + 6]
        blocks.append(np.einsum("mad,mbf->mabdf", of_joint, of_joint).reshape(-1, 36))
    return np.hstack(blocks)


def rank_and_gap(rows: Array, reciprocal: bool = False) -> tuple[int, float]:
    if reciprocal:
        tensors = rows.reshape(len(rows), -1, 6, 6)
        upper = np.triu_indices(6)
        both = (tensors + tensors.swapaxes(2, 3))[:, :, *upper]
        rows = both.reshape(len(rows), -1)
    values = np.linalg.svd(np.linalg.qr(rows, mode="r"), compute_uv=False)
    rank = int((values > 1e-9 * values[0]).sum())
    left = values[rank] if rank < len(values) else 0.0
    return rank, float(values[rank - 1] / max(left, 1e-16 * values[0]))


GOLDEN = {
    "wCAFYXZSt": (180, 123, 73),
    "wYXFZt": (108, 75, 45),
    "wFXYZCBt": (180, 116, 69),
    "wCBXFZYt": (180, 123, 73),
    "wBXFZAYt": (180, 123, 73),
    "wCXYFZBt": (180, 123, 73),
    "wXYFZCBt": (180, 123, 73),
    "wCAYfXZt": (180, 123, 73),
    "wYFBZXCt": (180, 120, 71),
    "wAFXYZt": (144, 96, 57),
    "wFYXt": (72, 52, 31),
    "wXYZFt": (108, 68, 41),
}


@pytest.mark.parametrize(("topology", "golden"), GOLDEN.items())
def test_the_totals_of_the_reference(topology: str, golden: tuple[int, int, int]) -> None:
    machine = machine_of(topology)
    general, reciprocal = ceiling(machine), ceiling(machine, reciprocal=True)
    assert (general.columns, general.rank, reciprocal.rank) == golden
    assert reciprocal.columns == golden[0] * 21 // 36
    assert np.linalg.matrix_rank(general.kernel / general.scales) == golden[0] - golden[1]


@pytest.mark.parametrize(("across", "total"), [(50.0, (118, 70)), (0.0, (116, 69))])
def test_two_rotary_axes_at_the_foundation_meet_or_pass(across: float, total: tuple[int, int]) -> None:
    machine = machine_of("wBFCXYZt", offset={"C": (across, 0.0, 0.0)})
    assert (ceiling(machine).rank, ceiling(machine, reciprocal=True).rank) == total


BRUTE = (
    ("the Hermle example", machine_of("wCAFYXZSt"), {}),
    ("links apart", machine_of("wCAYFXZt", {"A": (0.5, 0.2, 0.1), "C": (0.3, 0.4, 0.2), "X": (0.1, 0.7, 0.3)}), {}),
    ("an inclined axis", machine_of("wYXFZBt", {"B": (0.2, 0.0, 0.4)}, {"B": (0.6, 0.0, 0.0)}), {}),
    ("axes inclined and apart", machine_of("wBFCXYZt", {"C": (0.4, 0.1, 0.0)}, {"C": (0.3, 0.2, 0.0)}), {}),
    ("a rigid joint between", machine_of("wFXBYZt", rigid="B"), {}),
    ("rigid joints at the foundation", machine_of("wYCFAXZt", {"A": (0.2, 0.3, 0.4)}, rigid="CA"), {}),
    ("a joint held", machine_of("wCAFYXZt"), {"A": 0.4}),
    ("a rigid joint held", machine_of("wFXBYZt", rigid="B"), {"B": 0.4}),
    ("no joint on a branch", machine_of("wFXYZCBt"), {}),
    ("parallel linear axes", machine_of("wXYFUZVt"), {}),
    ("rotary axes in line", machine_of("wCFSZt", {"S": (0.0, 0.0, 0.3)}, rigid=""), {}),
    ("rotary axes parallel", machine_of("wCFSZt", {"S": (0.5, 0.0, 0.3)}, rigid=""), {}),
    ("one joint", machine_of("wFXt"), {}),
    *((topology, machine_of(topology), {}) for topology in GOLDEN),
)


@pytest.mark.parametrize("reciprocal", [False, True])
@pytest.mark.parametrize(("machine", "held"), [case[1:] for case in BRUTE], ids=[case[0] for case in BRUTE])
def test_the_closed_form_is_what_six_loads_and_six_readings_tell(
    machine: Machine, held: dict[str, float], reciprocal: bool
) -> None:
    found = ceiling(machine, reciprocal, held)
    rank, gap = rank_and_gap(six_component_rows(machine, held=held), reciprocal)
    assert found.rank == rank
    assert gap > 1e5 or rank == found.columns


@pytest.mark.parametrize(("machine", "held"), [case[1:] for case in BRUTE], ids=[case[0] for case in BRUTE])
def test_no_six_component_test_sees_the_kernel(machine: Machine, held: dict[str, float]) -> None:
    rows = six_component_rows(machine, held=held)
    kernel = ceiling(machine, held=held).kernel
    assert np.abs(rows @ kernel.T).max(initial=0.0) < 1e-9 * np.abs(rows).max() * np.abs(kernel).max(initial=1.0)


def test_names_that_are_no_compliance_are_refused() -> None:
    machine = machine_of("wYXFZt")
    with pytest.raises(InputError, match="C_XXQ: no compliance of a joint of this machine; they are C_XXX to C_CCZ"):
        ceiling(machine).among(["C_XXX", "C_XXQ"])
    with pytest.raises(InputError, match=r"C_YXX: .*the name of the one that stands for both"):
        ceiling(machine, reciprocal=True).unseen("C_YXX")
    with pytest.raises(MachineError, match="has no axis 'B'"):
        ceiling(machine, held={"B": 0.0})


def test_a_place_and_its_carriage_are_one_spring() -> None:
    plain, placed = (machine_of("wFYXt", places=places) for places in ((), (Place("holder", "X", (10.0, 0.0, -50.0)),)))
    found = ceiling(placed)
    assert (found.columns, found.rank) == (108, ceiling(plain).rank)
    assert found.among([name for name in found.labels if not name.endswith("X")]) == 52


def test_some_compliances_alone_have_a_ceiling_of_their_own() -> None:
    found = ceiling(machine_of("wCAFYXZSt"))
    assert found.among(found.labels) == 123
    assert found.among([name for name in found.labels if name[-1] in "XYZ"]) == ceiling(machine_of("wFYXZt")).rank == 68
    assert found.among(["C_XXX", "C_XXY"]) == 1
    assert found.among(["C_XXX", "C_CCY"]) == 2


def test_only_what_no_test_changes_is_ever_known_alone() -> None:
    found = ceiling(machine_of("wCAFYXZSt"))
    assert found.unseen("C_XXX")
    assert found.unseen("C_XXY")
    assert found.unseen("C_AAX")
    assert found.unseen("C_CCX")
    assert not found.unseen("C_BBX")


X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
BESIDE, ABOVE = (40.0, 70.0, -20.0), (40.0, 70.0, 90.0)
ORIGIN = (0.0, 0.0, 0.0)


def motion(axis: str, at: tuple[float, float, float] = ORIGIN, tilt: tuple[float, float, float] = ORIGIN) -> Array:
    """Generator of an axis (X Y Z slide, A B C turn) whose frame sits at a point and is inclined."""
    frame = Frame(rotation_matrix(np.array([tilt])), np.array([at]))
    return generator(frame, "XYZABC".index(axis) % 3, axis in "ABC")


@pytest.mark.parametrize(
    ("what", "motions", "dimensions"),
    [
        ("nothing", [], (36, 21)),
        ("linear", [motion("X")], (20, 11)),
        ("linear, inclined", [motion("X", BESIDE, (0.3, 0.2, 0.5))], (20, 11)),
        ("rotary", [motion("B", BESIDE)], (12, 7)),
        ("rotary with perpendicular linear", [motion("A", BESIDE), motion("Y")], (5, 3)),
        ("rotary with parallel linear", [motion("A", BESIDE), motion("X")], (8, 5)),
        ("two perpendicular linears", [motion("X"), motion("Z")], (13, 7)),
        ("parallel linears", [motion("X"), motion("X", BESIDE)], (20, 11)),
        ("rotaries in line", [motion("C", BESIDE), motion("C", ABOVE)], (12, 7)),
        ("rotaries parallel, apart", [motion("C"), motion("C", BESIDE)], (5, 3)),
        ("rotaries that intersect", [motion("C", BESIDE), motion("A", BESIDE)], (4, 3)),
        ("rotaries that are skew", [motion("C"), motion("A", BESIDE)], (2, 2)),
    ],
)
def test_the_dimensions_of_the_reference(what: str, motions: list[Array], dimensions: tuple[int, int]) -> None:
    found = [invariants(motions, reciprocal) for reciprocal in (False, True)]
    assert tuple(map(len, found)) == dimensions, what
    for tensors in found:
        for G in motions:
            assert np.abs(G @ tensors + tensors @ G.T).max() < 1e-6 * np.abs(tensors).max() * np.abs(G).max()
    assert np.array_equal(found[1], found[1].transpose(0, 2, 1))


@given(
    axes=st.permutations(list("XYZABC")),
    count=st.integers(2, 4),
    cut=st.integers(0, 4),
    rigid=st.sets(st.sampled_from("XYZABC"), max_size=2),
    held=st.sets(st.sampled_from("XYZABC"), max_size=2),
    seed=st.integers(0, 10**6),
)
@settings(max_examples=20)
def test_the_closed_form_holds_for_any_loop(
    axes: list[str], count: int, cut: int, rigid: set[str], held: set[str], seed: int
) -> None:
    """Any order of axes, each in line or apart, upright or inclined, rigid or held, against six loads and six readings."""
    random, axes = np.random.default_rng(seed), axes[:count]
    if set(axes) <= rigid:
        rigid = set()
    apart = {axis: tuple(random.uniform(-1, 1, 3)) for axis in axes if random.random() < 0.5}
    inclined = {axis: tuple(random.uniform(-1, 1, 3)) for axis in axes if random.random() < 0.3}
    topology = f"w{''.join(axes[:cut])}F{''.join(axes[cut:])}t"
    machine = machine_of(topology, apart, inclined, rigid="".join(rigid))
    at = {axis: 0.3 for axis in held if axis in axes}
    rows = six_component_rows(machine, poses=10, held=at)
    assert ceiling(machine, held=at).rank == rank_and_gap(rows)[0]
    assert ceiling(machine, True, at).rank == rank_and_gap(rows, reciprocal=True)[0]
