"""Which of the languages that share the words of ISO 6983 a program is in: by words that only one of them has."""

from __future__ import annotations

import re

_KLARTEXT = re.compile(rb"\s*(?:\d+\s+)?BEGIN PGM\b")
_SINUMERIK = re.compile(
    rb"(?im)^%_N_|\b(?:CR|TURN|AR|AP|RP)\s*=|\b[A-Z]\s*=\s*(?:AC|IC|DC)\s*\("
    rb"|^\s*(?:N\d+\s*)?(?:MSG|FGROUP|CYCLE\d+|EXTERN|DEF)\s*[( ]"
    rb"|\b(?:TRAORI|TRAFOOF|STOPRE|SUPA|CFTCP|FFWON|BRISK|SOFT|DIAMOF|TRANS|AROT)\b|\bG(?:710|700|500|642)\b|\bR\d+\s*="
)
_LINUXCNC = re.compile(
    rb"(?im)\(\s*linuxcnc\b|\bG0?[46]4?\s*P\d*\.\d|\bG9[01]\.1\b|\(\s*(?:MSG|PRINT|DEBUG)\s*,|#<_?[a-z]"
    rb"|^\s*o\d+\s*(?:sub|call|while|if|repeat|do)\b"
)
_CODE = re.compile(rb"(?im)^\s*/?\s*(?:N\s*\d+\s*)?(?:[XYZABCUVWFSTMIJKRHD]\s*[-+]?[\d.]+\s*)*G\s*\d")
_PROSE = re.compile(rb"(?i)^[\s%/]*(?:[A-Z]\s*[-+.\d#\[<]|[(;%]|$)")


def language(head: bytes) -> str:
    """`heidenhain`, `sinumerik`, `linuxcnc` or `iso`; empty for what is no program of these."""
    if _KLARTEXT.match(head):
        return "heidenhain"
    if b"\0" in head:
        return ""
    if _SINUMERIK.search(_bare(head)) and _CODE.search(head):
        return "sinumerik"
    first = next((line for line in head.splitlines() if line.strip()), b"")
    if not _CODE.search(head) or not _PROSE.match(first):
        return ""
    return "linuxcnc" if _LINUXCNC.search(head) else "iso"


def _bare(head: bytes) -> bytes:
    """Without comments: a bracket right behind a name is that of a function."""
    return re.sub(rb"(?<![\w=])\([^()\n]*\)|;[^\n]*", b"", head)
