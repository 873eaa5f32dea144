"""Sphinx configuration: MyST pages, furo, MathJax from an installed wheel. No page asks another host for anything."""

from pathlib import Path

from elastogeo import __version__

project = "elastogeo"
author = copyright = "The elastogeo developers"
release = version = __version__

extensions = ["myst_parser", "sphinx.ext.mathjax", "sphinx-mathjax-offline"]
myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

exclude_patterns = ["_build"]

READ_FIRST = ["tutorial", "ball-bar", "conventions", "theory", "api", "cli"]

html_theme = "furo"
html_title = f"elastogeo {release}"
html_copy_source = False


def list_pages(_app, docname, source):
    """Put the pages that exist into the index, in the order in which to read them; the others follow by name."""
    if docname != "index":
        return
    others = sorted(page.stem for page in Path(__file__).parent.glob("*.md") if page.stem not in ("index", *READ_FIRST))
    pages = [name for name in [*READ_FIRST, *others] if Path(__file__).with_name(f"{name}.md").exists()]
    source[0] = source[0].replace("(pages)", "\n".join(pages))


def setup(app):
    """Let Sphinx call us as it reads each page."""
    app.connect("source-read", list_pages)
