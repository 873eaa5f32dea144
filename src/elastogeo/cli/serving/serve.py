"""`elastogeo serve`: the pages, for a browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from elastogeo.cli.options import STORE, Store, Who

DEMO = Path("elastogeo-demo") / "history.db"
"""Where the demo's history is made: it can be deleted at any time."""


def serve(
    context: typer.Context,
    store: Store = STORE,
    demo: Annotated[bool, typer.Option("--demo", help="Show a simulated fleet, made in the folder elastogeo-demo.")] = False,
    host: Annotated[str, typer.Option(help="Where to listen; another than this computer needs accounts.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=1, max=65535, help="Port to listen at.")] = 8347,
    prefix: Annotated[str, typer.Option(help="Prefix of all addresses behind a proxy, such as /elastogeo.")] = "",
    accounts: Annotated[bool, typer.Option("--accounts", help="Let nobody in without an account, here either.")] = False,
    allow_host: Annotated[list[str] | None, typer.Option(help="Name by which a browser may call; may be repeated.")] = None,
    behind_https: Annotated[bool, typer.Option("--behind-https", help="A proxy in front speaks https.")] = False,
    worker: Annotated[bool, typer.Option(help="Do what takes long, or leave it to elastogeo history work.")] = True,
    who: Who = "",
) -> None:
    """Show the machines, what changed and why, in a browser.

    \b
    Examples:
      elastogeo serve --demo
      elastogeo serve --store shop.db
    """
    from elastogeo.cli.screen import say
    from elastogeo.errors import InputError
    from elastogeo.web import Settings
    from elastogeo.web import serve as run

    source = context.get_parameter_source("store")
    if demo and source is not None and source.name == "COMMANDLINE":
        raise InputError(
            f"--demo shows a history of its own, {DEMO}, not {store}; leave out --store, or fill a new history with: "
            "elastogeo history demo NEW.db"
        )
    if demo:
        DEMO.parent.mkdir(exist_ok=True)
    run(
        Settings(
            str(DEMO) if demo else store, host=host, port=port, prefix=f"/{prefix.strip('/')}" if prefix.strip("/") else "",
            accounts=accounts, hosts=tuple(allow_host or ()), behind_https=behind_https, worker=worker, demo=demo, who=who,
        ),
        say,
    )  # fmt: skip
