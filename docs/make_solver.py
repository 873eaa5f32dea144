"""Write the page on the solver's accuracy, docs/solver.md: `python docs/make_solver.py [folder of the .dat files]`.

The data of the NIST Statistical Reference Datasets (linear regression) are in the public domain and can be downloaded from
NIST. Without them only the sets of Wampler are measured, by their formulas, and the page is left alone. It is left alone too
if this processor cannot run every kernel that the page names. With `--json` it prints what this process measures, no more.
"""

import json
import math
import os
import re
import subprocess
import sys
import warnings
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np
import scipy.linalg

from elastogeo.estimate.factor import Array, Factor, factor_blocks
from elastogeo.estimate.refinement import refine
from elastogeo.estimate.solution import solve

PAGE = Path(__file__).with_name("solver.md")
FOLDER = Path(__file__).resolve().parents[2] / "shared" / "data" / "nist-strd"
NAMES = (
    "Norris", "Pontius", "NoInt1", "NoInt2", "Longley", "Filip",
    "Wampler1", "Wampler2", "Wampler3", "Wampler4", "Wampler5",
)  # fmt: skip
MOST_DIGITS = 15.0
"""As many digits as NIST certifies."""

KERNELS = ("Prescott", "Nehalem", "Sandybridge", "Haswell", "Zen", "SkylakeX")
"""Processors whose code OpenBLAS can be told to run (`OPENBLAS_CORETYPE`): they sum in different orders."""

DISTURBANCE = (
    759, -2048, 2048, -2048, 2523, -2048, 2048, -2048, 1838, -2048, 2048,
    -2048, 1838, -2048, 2048, -2048, 2523, -2048, 2048, -2048, 759,
)  # fmt: skip
"""What Wampler adds to the readings of his quintic, times 0, 1, 100 or 10000: orthogonal to every quintic on 0 to 20."""


@dataclass(frozen=True)
class Reference:
    """A regression with certified results: design (m, p), readings (m,), values (p,), standard deviations (p,)."""

    name: str
    design: Array
    readings: Array
    values: Array
    deviations: Array
    residual_deviation: float

    @property
    def rows(self) -> Array:
        """A fresh `[A | y]`."""
        return np.column_stack([self.design, self.readings])

    @property
    def factor(self) -> Factor:
        """Our factor of it."""
        return factor_blocks([f"B{k}" for k in range(self.design.shape[1])], [self.rows])


@dataclass(frozen=True)
class Digits:
    """Correct digits of the worst value and of the worst standard deviation; none where a solver does not give any."""

    values: float
    deviations: float | None


Measured = dict[str, dict[str, Digits]]
"""Digits by set and by solver."""


def read(path: Path) -> Reference:
    """A set as NIST publishes it."""
    text = path.read_text(encoding="ascii")
    certified = re.findall(r"^\s+B\d+\s+(\S+)\s+(\S+)\s*$", text, flags=re.MULTILINE)
    values, deviations = np.array(certified, dtype=float).T
    first, last = re.search(r"Data\s+\(lines (\d+) to (\d+)\)", text).groups()
    data = np.array([line.split() for line in text.splitlines()[int(first) - 1 : int(last)]], dtype=float)
    residual = float(re.search(r"Residual\s+Standard Deviation\s+(\S+)", text)[1])
    y, x = data[:, 0], data[:, 1:]
    if path.stem.startswith("NoInt"):
        design = x
    elif x.shape[1] > 1:
        design = np.column_stack([np.ones(len(y)), x])
    else:
        design = np.vander(x[:, 0], len(values), increasing=True)
    return Reference(path.stem, design, y, values, deviations, residual)


def wampler(number: int) -> Reference:
    """A set of Wampler by its formula: a quintic on 0 to 20 with coefficients 1 (of the second set 10^-k), disturbed."""
    x = np.arange(21)
    design = np.vander(x, 6, increasing=True)
    exact = [Fraction(1, 10**k) if number == 2 else Fraction(1) for k in range(6)]
    size = {3: 1, 4: 100, 5: 10_000}.get(number, 0)
    pairs = zip(design.tolist(), DISTURBANCE, strict=True)
    readings = [sum(a * b for a, b in zip(row, exact, strict=True)) + size * delta for row, delta in pairs]
    square = sum((size * delta) ** 2 for delta in DISTURBANCE)
    variances = [float(value * square / 15) for value in np.diag(exact_inverse(design))]
    return Reference(
        f"Wampler{number}",
        design.astype(float),
        np.array([float(value) for value in readings]),
        np.array([float(value) for value in exact]),
        np.sqrt(variances),
        float(np.sqrt(square / 15)),
    )


def exact_inverse(design: Array) -> np.ndarray:
    """Inverse of `A^T A` in rational arithmetic, shape (p, p), of fractions."""
    A = np.array([[Fraction(value) for value in row] for row in design.tolist()], dtype=object)
    size = A.shape[1]
    both = np.column_stack([A.T @ A, np.array([[Fraction(int(i == j)) for j in range(size)] for i in range(size)])])
    for pivot in range(size):
        both[pivot] = both[pivot] / both[pivot, pivot]
        for row in range(size):
            if row != pivot:
                both[row] = both[row] - both[row, pivot] * both[pivot]
    return both[:, size:]


def references(folder: Path = FOLDER) -> tuple[list[Reference], str]:
    """The sets that are there, in NIST's order of difficulty, and where they come from."""
    if folder.is_dir():
        return [read(folder / f"{name}.dat") for name in NAMES], f"the files of NIST in {folder}"
    return [wampler(number) for number in range(1, 6)], f"formulas (Wampler only: there is no {folder})"


def digits(estimated: Array, certified: Array) -> float:
    """Correct digits of the worst: minus the log of the relative error (of the error itself where zero is certified)."""
    error = np.abs(np.asarray(estimated) - certified) / np.where(certified == 0, 1.0, np.abs(certified))
    return float(np.clip(-np.log10(np.maximum(error, 10.0**-MOST_DIGITS)), 0.0, MOST_DIGITS).min())


def _ours(reference: Reference) -> tuple[Array, Array]:
    solution = solve(reference.factor)
    return solution.values, solution.standard_uncertainty


def _refined(reference: Reference) -> tuple[Array, Array]:
    solution = refine(reference.factor, [reference.rows])
    return solution.values, solution.standard_uncertainty


def _numpy(reference: Reference) -> tuple[Array, None]:
    return np.linalg.lstsq(reference.design, reference.readings)[0], None


def _scipy(reference: Reference) -> tuple[Array, None]:
    return scipy.linalg.lstsq(reference.design, reference.readings)[0], None


def _statsmodels(reference: Reference) -> tuple[Array, Array]:
    import statsmodels.api

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it warns of a singular matrix on Filip; the page says so
        fitted = statsmodels.api.OLS(reference.readings, reference.design).fit()
    return fitted.params, fitted.bse


SOLVERS: dict[str, Callable[[Reference], tuple[Array, Array | None]]] = {
    "elastogeo": _ours,
    "refined": _refined,
    "numpy": _numpy,
    "scipy": _scipy,
    "statsmodels": _statsmodels,
}


def measure(reference: Reference) -> dict[str, Digits]:
    """Digits of every solver on one set."""
    results = {}
    for name, solver in SOLVERS.items():
        values, deviations = solver(reference)
        worst = None if deviations is None else digits(deviations, reference.deviations)
        results[name] = Digits(digits(values, reference.values), worst)
    return results


def measure_all(chosen: Iterable[Reference]) -> Measured:
    """Digits of every solver on every set, as this process computes."""
    return {reference.name: measure(reference) for reference in chosen}


def on_kernel(kernel: str, folder: Path) -> Measured:
    """The same in a process of its own that runs the code for another processor."""
    command = [sys.executable, str(Path(__file__).resolve()), "--json", str(folder)]
    run = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OPENBLAS_CORETYPE": kernel})
    if run.returncode:
        raise RuntimeError(f"this processor does not run the code for {kernel}, so the page stays as it is: {run.stderr}")
    return {name: {way: Digits(*pair) for way, pair in ways.items()} for name, ways in json.loads(run.stdout).items()}


def least(measured: Iterable[Measured]) -> Measured:
    """The worst of several measurements, figure by figure."""
    first, *others = measured
    return {
        name: {
            way: Digits(
                min([one.values, *(other[name][way].values for other in others)]),
                None if one.deviations is None else min([one.deviations, *(o[name][way].deviations for o in others)]),
            )
            for way, one in ways.items()
        }
        for name, ways in first.items()
    }


def figure(value: float | None) -> str:
    """Digits as the page states them: never rounded up."""
    return "–" if value is None else f"{math.floor(10 * value + 1e-9) / 10:.1f}"


def table(measured: Mapping[str, Mapping[str, Digits]]) -> str:
    """The table of the page: digits of values, then of standard deviations."""
    lines = ["| set | " + " | ".join(SOLVERS) + " |", "|---" * (len(SOLVERS) + 1) + "|"]
    for name, ways in measured.items():
        cells = [f"{figure(result.values)} / {figure(result.deviations)}" for result in ways.values()]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


TEXT = """\
# How right the solver is

The least-squares solver is the floor under every number of this program, so it is measured against results that are known
to 15 digits: the linear-regression sets of the NIST Statistical Reference Datasets, and, where those files are not at hand,
the sets of Wampler, which follow from a formula.

This page is written by `docs/make_solver.py`: run `python docs/make_solver.py folder-of-the-dat-files` to measure on your
machine. The figures are correct digits (minus the logarithm of the relative error) of the worst coefficient, then of the
worst standard deviation; 15 is the most, and a dash stands where a solver gives no standard deviations.

All but those of *refined* depend on the order in which a processor adds, by up to a digit and more. Each figure is therefore
the least that the code of OpenBLAS for six processors gives ({kernels}), cut to a tenth and not rounded. On a processor
that is not among them it may be some tenths lower; a test fails if it is lower by a whole digit, or below what is promised.

{table}

What to read in it:

- **elastogeo** is `solve`: columns of unit length, Householder factorisation of the rows as they stream past, no rank cut in
  silence. It keeps what float64 arithmetic can keep: about 16 digits, less those of the condition number. On *Filip*, a
  polynomial of the tenth degree on -9 to -3 whose scaled condition number is 5 · 10⁹, the order of the rows decides too:
  in 91 to 100 of 100 random orders, by processor, all figures have 7.5 digits or more, in the worst of 300 orders 7.2. The
  limit is in the data: if every number of the design is off by up to half a unit in its last place, exact arithmetic has 7.5
  digits in 80 of 100 cases, and 7.3 in the worst of 60 (decision 10).
- **refined** is `elastogeo.estimate.refine(factor, blocks)`, which takes the rows once more: one step of iterative
  refinement with residuals, and the products of columns, in doubled precision. It reaches the exact solution of the float64
  data to 12 digits (a test compares it with rational arithmetic); what is missing from 15 in the table, the data lost when
  they were written in float64, and where the plain solution shows more, that is chance. The result does not depend on the
  order of the rows, the size of blocks, or the platform. Use it when a confounding report calls the problem weak and the
  answer still matters; an ordinary test of a machine gains nothing from it, its noise is ten digits above.
- **numpy** and **scipy** are `lstsq` as called by default, **statsmodels** is `OLS(...).fit()` by default. None scales
  columns. On *Filip* numpy takes the design for rank 10 of 11 and returns the coefficients of another problem; the rank
  stands in its answer, for those who look. statsmodels does the same, with a warning.

What refinement cannot do: a design matrix that was rounded when it was formed is another design matrix. Centre and scale
polynomials *before* they are written down; this program does so with every error motion.

## The worked examples of the GUM

The other half of the arithmetic, propagation of uncertainty, goes through the worked examples of JCGM 100 (H.1 end gauge,
H.2 resistance and reactance, H.3 thermometer, H.5 analysis of variance), of JCGM 101 (9.2 sums, 9.3 mass, 9.4 comparison
loss, 9.5 gauge block) and of JCGM 102 (9.3 magnitude and phase; resistance and reactance together). Where a closed form
exists, the Monte Carlo result is held against that as well, within the error that its number of trials allows. The source
of every published figure stands beside it in `tests/estimate/test_gum_examples.py`.

Where first-order propagation is wrong, the examples say so too: the mass of 9.3 has an uncertainty of 0.075 mg where the
law of propagation gives 0.054 mg, and the comparison loss of 9.4 one of 5 · 10⁻⁵ where it gives none. This is why every
budget here comes with both, and with their agreement stated.
"""


def page(measured: Mapping[str, Mapping[str, Digits]]) -> str:
    """The page as it should be."""
    return TEXT.format(table=table(measured), kernels=", ".join(KERNELS))


def main(arguments: list[str]) -> None:
    """Measure, show, and write the page if every set is there."""
    *only, folder = arguments if arguments and arguments[-1] != "--json" else [*arguments, str(FOLDER)]
    sets, origin = references(Path(folder))
    here = measure_all(sets)
    if only == ["--json"]:
        print(json.dumps({name: {way: [d.values, d.deviations] for way, d in ways.items()} for name, ways in here.items()}))
        return
    print(f"Correct digits here (values / standard deviations), from {origin}:\n\n{table(here)}")
    if len(sets) == len(NAMES):
        worst = least([on_kernel(kernel, Path(folder)) for kernel in KERNELS])
        print(f"\nThe least of the code for {', '.join(KERNELS)}:\n\n{table(worst)}")
        PAGE.write_text(page(worst), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
