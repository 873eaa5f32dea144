"""The example for programs, as it stands on its page: with a token, at a server that lets nobody in without."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from elastogeo.history import History
from tests.web.fleets import FLEET

PAGE = Path(__file__).resolve().parents[2] / "docs" / "web.md"


def test_the_example_for_programs_runs(fleet: Path, serve: Any, capsys: Any) -> None:
    with History(fleet, who="A. Miller") as history:
        history.add_account("A. Miller", "administrator", "a long enough password")
        token = history.make_token("A. Miller", "an example").secret
    site = serve(fleet, "--accounts")
    (code,) = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    given = code.replace("http://127.0.0.1:8347", site.url).replace("the token", token)
    assert given.count(site.url) == given.count(token) == 1
    exec(compile(given, str(PAGE), "exec"), {"__name__": "__main__"})
    told = capsys.readouterr().out.splitlines()
    assert {line.rpartition(" ")[2] for line in told} >= {"alarm", "suspect", "overdue"}
    assert {one.story.name for one in FLEET} <= {line.rpartition(" ")[0] for line in told}
