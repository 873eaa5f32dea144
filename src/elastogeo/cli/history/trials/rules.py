"""`elastogeo history rules`: the rule tried out, on machines as they are expected or on one's own series."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, OfSeries, Report, Store


def rules(
    machine: Annotated[str, typer.Argument(help="Machine whose series is tried, by name; none: any machine.")] = "",
    series: OfSeries = "",
    alpha: Annotated[
        float | None, typer.Option(help="False alarms of one test that the limits are made from; of the series, or 0.005.")
    ] = None,
    interval: Annotated[float | None, typer.Option(help="Days between tests; those of the series, or 30.")] = None,
    tests: Annotated[int, typer.Option(help="Tests after the baseline.", min=1)] = 36,
    baseline: Annotated[int, typer.Option(help="Tests of the baseline of any machine.", min=1)] = 10,
    blunders: Annotated[float, typer.Option(help="Share of tests in which a ball is badly seated: 0.03.")] = 0.0,
    correlation: Annotated[float, typer.Option(help="Of each test with the one before.")] = 0.0,
    machines: Annotated[int, typer.Option(help="How many to simulate.", min=1)] = 2000,
    store: Store = STORE,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Try the rule: false alarms, and how soon it finds a change.

    Machines are simulated that scatter as the baseline of the series does, or as any machine is expected to.

    \b
    Examples:
      elastogeo history rules --interval 14
      elastogeo history rules "Mill 3" --blunders 0.03
    """
    from elastogeo.changes import Rule, try_rule
    from elastogeo.cli import screen

    with screen.progress("Simulate machines", as_json):
        if machine:
            with eg.History(store) as history:
                found = history.try_rule(
                    machine,
                    series,
                    alpha=alpha,
                    interval=interval,
                    tests=tests,
                    machines=machines,
                    blunders=blunders,
                    correlation=correlation,
                )
        else:
            found = try_rule(
                rule=Rule() if alpha is None else Rule(alpha=alpha),
                baseline_tests=baseline,
                interval=interval,
                tests=tests,
                machines=machines,
                blunders=blunders,
                correlation=correlation,
            )
    screen.show(found, report, as_json)
