"""What somebody wrote on a page or in a file does not command the terminal of who reads it."""

import elastogeo as eg
from elastogeo.cli.plain import plain

ESCAPES = "\x1b]0;pwned\x07\x1b[2J\x9b31m\x00\u202etxt"


def test_a_note_of_a_page_does_not_command_the_terminal(tmp_path, elastogeo):
    with eg.History(tmp_path / "h.db", create=True, who="B. Smith") as history:
        history.add_machine("Mill 3")
        history.add_event("note", f"oil{ESCAPES}changed", machine="Mill 3")
        history.add_instrument("B-7", calibrated="2026-01-01", certificate=f"K{ESCAPES}")
    for what in ("event", "instrument", "audit"):
        code, out, err = elastogeo("history", what, "--store", tmp_path / "h.db")
        assert code == 0
        assert not set(out + err) & set("\x1b\x07\x9b\x00\u202e"), what
    code, out, err = elastogeo("history", "show", f"none{ESCAPES}", "--store", tmp_path / "h.db")
    assert (code, "\x1b" in out + err) == (2, False)


def test_words_and_lines_stay_as_they_are():
    said = "Fräse 3\tµm \u2009±\xa05\n日本 👩\u200d🔧"
    assert plain(said) == said
