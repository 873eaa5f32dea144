"""The notebooks run: every cell in order, and what a cell ends in can be shown as HTML or text."""

import ast
import json
from pathlib import Path

import pytest

NOTEBOOKS = sorted((Path(__file__).parent.parent / "examples").glob("*.ipynb"))


def shown(source: str, namespace: dict[str, object]) -> str:
    """Run a cell; what a notebook would show of its last expression."""
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "<cell>", "exec"), namespace)
    if last is None:
        return ""
    value = eval(compile(ast.Expression(last.value), "<cell>", "eval"), namespace)  # type: ignore[attr-defined]
    return str(value._repr_html_()) if hasattr(value, "_repr_html_") else "" if value is None else repr(value)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_every_cell_of_a_notebook_runs(path: Path) -> None:
    document = json.loads(path.read_text(encoding="utf-8"))
    assert document["nbformat"] == 4
    cells = ["".join(cell["source"]) for cell in document["cells"] if cell["cell_type"] == "code"]
    assert len(cells) >= 5
    namespace: dict[str, object] = {}
    outputs = [shown(cell, namespace) for cell in cells]
    html = [text for text in outputs if "<table>" in text]
    assert len(html) >= 3, "a result is shown as a table"
    assert "C_XXX = " in "".join(outputs)
    assert not any(cell["outputs"] for cell in document["cells"] if cell["cell_type"] == "code"), "stored without outputs"


def test_there_is_a_notebook() -> None:
    assert [path.name for path in NOTEBOOKS] == ["first-look.ipynb"]
