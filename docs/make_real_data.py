"""Write what docs/real-data.md shows of the program, its figures and Table 5.9: `python docs/make_real_data.py`."""

import re
import shutil
import tempfile
from pathlib import Path

import elastogeo as eg

DOCS = Path(__file__).parent
PAGE = DOCS / "real-data.md"
EXAMPLE = DOCS.parent / "examples/hermle-c50-reconstructed"
BEGIN, END = "<!-- Table 5.9, by docs/make_real_data.py -->", "<!-- end of Table 5.9 -->"
PRINTED = {36: (91.7, 93.0, 93.7), 238: (92.4, 94.2, 95.3), 364: (92.5, 93.8, 95.4), 490: (93.0, 94.2, 95.8)}
PRINTED |= {616: (93.4, 94.6, 96.0), 742: (93.9, 95.0, 96.2)}
FIGURES = {
    "4": (EXAMPLE / "chapter-4", ("traces", "parts", "local-traces", "local")),
    "5": (EXAMPLE, ("traces", "separation", "parts", "local-traces", "local-separation", "local", "models")),
}


def table_5_9() -> str:
    """The fitness of each level by three models, beside the printed one."""
    levels = eg.identify(eg.read_test(EXAMPLE)).levels
    lines = [
        "| force [N] | constant [%] | printed | linear [%] | printed | local [%] | printed |",
        "|---|---|---|---|---|---|---|",
    ]
    for level in levels:
        constant, linear, local = PRINTED[round(level.force)]
        lines.append(
            f"| {level.force:g} | {level.fitness:.1f} | {constant} | {level.variable.fitness:.1f} | {linear} | "
            f"{level.local.fitness:.1f} | {local} |"
        )
    return "\n".join(lines)


def with_table(page: str) -> str:
    """The page with the table as it should be."""
    return re.sub(f"(?s){BEGIN}.*?{END}", lambda _: f"{BEGIN}\n{table_5_9()}\n{END}", page)


def main() -> None:
    PAGE.write_text(with_table(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    for chapter, (folder, names) in FIGURES.items():
        with tempfile.TemporaryDirectory() as scratch:
            eg.identify(eg.read_test(folder)).report(scratch)
            for name in names:
                shutil.copy(Path(scratch) / f"{name}.svg", DOCS / f"real-data-{chapter}-{name}.svg")


if __name__ == "__main__":
    main()
