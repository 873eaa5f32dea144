"""A view that is kept as plain values and read again: what takes long to draw is drawn once.

Its document and rows are not in it: they are kept beside, as the analysis's own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Any

from elastogeo.report.drawing.plots import Plot, plot_of
from elastogeo.report.drawing.svg import drawn, inline
from elastogeo.report.view import Badge, KeyValue, Picture, Said, Section, Table, View

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, slots=True)
class KeptView:
    """A view as it was kept, and its pictures.

    Attributes
    ----------
    view : View
        Its pictures cannot be drawn again.
    figures : mapping of str to bytes
        Each of its pictures as an SVG file, by name: for `html_page` and `pdf_page`.
    """

    view: View
    figures: Mapping[str, bytes]

    def element(self, name: str) -> str:
        """A picture as an SVG element inside a page, in the page's own colours."""
        return inline(self.figures[name], self.view.pictures[name])


def kept_view(view: View) -> dict[str, Any]:
    """A view as plain values, with its pictures drawn; without its document, rows and scene.

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    """
    return {
        **_plain(replace(view, document={}, rows=(), picture=None, sections=(), tables=(), scene=None)),
        "tables": [_table(table) for table in view.tables],
        "sections": [_section(section) for section in view.sections],
        "picture": None if view.picture is None else view.picture.name,
        "pictures": {name: _picture(picture) for name, picture in view.pictures.items()},
    }


def view_kept(kept: Mapping[str, Any], document: Mapping[str, Any] | None = None) -> KeptView:
    """What `kept_view` gave, as a view again.

    Parameters
    ----------
    kept : mapping
    document : mapping, optional
        The document that the view has.
    """
    pictures = {name: _picture_of(name, entry) for name, entry in kept["pictures"].items()}
    view = View(
        kind=kept["kind"],
        title=kept["title"],
        subtitle=kept["subtitle"],
        origin=kept["origin"],
        head=tuple((label, text) for label, text in kept["head"]),
        sentence=kept["sentence"],
        values=tuple(KeyValue(**entry) for entry in kept["values"]),
        picture=pictures.get(kept["picture"] or ""),
        checks=tuple(Said(**entry) for entry in kept["checks"]),
        document=document or {},
        alert=tuple(kept["alert"]),
        tables=tuple(map(_table_of, kept["tables"])),
        notes=tuple(kept["notes"]),
        sections=tuple(_section_of(entry, pictures) for entry in kept["sections"]),
        badge=None if kept["badge"] is None else Badge(**kept["badge"]),
        advice=tuple(kept["advice"]),
    )
    return KeptView(view, {name: entry["svg"].encode() for name, entry in kept["pictures"].items()})


def _plain(part: Any) -> dict[str, Any]:
    return {name: list(value) if isinstance(value, tuple) else value for name, value in asdict(part).items()}


def _picture(picture: Picture) -> dict[str, Any]:
    plots = {"plain": picture.plain, "narrow": picture.narrow}
    return {
        "caption": picture.caption,
        "alternative": picture.alternative,
        "svg": drawn(picture).decode(),
        **{name: None if draw is None else draw().to_dict() for name, draw in plots.items()},
    }


def _picture_of(name: str, entry: Mapping[str, Any]) -> Picture:
    def draw() -> Figure:
        raise LookupError(f"the picture {name} was drawn when its view was kept, and cannot be drawn again")

    def plotted(kind: str) -> Any:
        return None if entry[kind] is None else lambda: plot_of(entry[kind])

    return Picture(name, entry["caption"], entry["alternative"], draw, plotted("plain"), plotted("narrow"))


def _table(table: Table) -> dict[str, Any]:
    return {**_plain(replace(table, sparks=())), "sparks": [spark.to_dict() for spark in table.sparks]}


def _table_of(entry: Mapping[str, Any]) -> Table:
    lists = {name: tuple(value) for name, value in entry.items() if isinstance(value, list)}
    sparks: tuple[Plot, ...] = tuple(map(plot_of, entry["sparks"]))
    rows = tuple(tuple(row) for row in entry["rows"])
    return Table(**{**entry, **lists, "rows": rows, "sparks": sparks})


def _section(section: Section) -> dict[str, Any]:
    return {
        **_plain(replace(section, pictures=(), tables=())),
        "pictures": [picture.name for picture in section.pictures],
        "tables": [_table(table) for table in section.tables],
    }


def _section_of(entry: Mapping[str, Any], pictures: Mapping[str, Picture]) -> Section:
    return Section(
        title=entry["title"],
        paragraphs=tuple(entry["paragraphs"]),
        pictures=tuple(pictures[name] for name in entry["pictures"]),
        tables=tuple(map(_table_of, entry["tables"])),
        points=tuple(entry["points"]),
        note=entry["note"],
    )
