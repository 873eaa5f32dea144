"""Requests that schemathesis makes of the OpenAPI, right and wrong ones: no fault, and nothing written without the role."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, Verbosity, given, seed, settings
from schemathesis import GenerationMode
from schemathesis.config import GenerationConfig, ProjectConfig, ProjectsConfig, SchemathesisConfig

from elastogeo.web.asking import ADMINISTRATOR, ANYBODY, ENGINEER, READER, ROLES
from tests.web.guard.conftest import Shop

SHORT, LONG = 3, 150
"""Requests of an address every day, and every night."""
OWN = ("/logout", "/tokens/{number}/end", "/password")
"""What would shut ourselves out."""


@pytest.fixture(scope="module")
def own(make_shop: Callable[..., Shop]) -> Iterator[Shop]:
    found = make_shop(hosts=())
    yield found
    found.history.close()


def operations(shop: Shop) -> list[Any]:
    """Every address of the OpenAPI, with what makes requests of it, such as fit and such as do not."""
    program = shop.program(shop.tokens[READER])
    document = program.get("http://localhost/openapi.json").json()
    generation = GenerationConfig(modes=[GenerationMode.POSITIVE, GenerationMode.NEGATIVE])
    config = SchemathesisConfig(projects=ProjectsConfig(default=ProjectConfig(generation=generation)))
    schema = schemathesis.openapi.from_dict(document, config=config)
    return [found.ok() for found in schema.get_all_operations()]


def asked(shop: Shop, operation: Any, token: str, often: int, check: Callable[[Any, Any], None]) -> None:
    program = shop.program(token)

    @seed(20261122)
    @settings(
        max_examples=often, deadline=None, database=None, phases=[Phase.explicit, Phase.generate], verbosity=Verbosity.quiet,
        suppress_health_check=list(HealthCheck),
    )  # fmt: skip
    @given(operation.as_strategy())
    def one(case: Any) -> None:
        how = case.as_transport_kwargs(base_url="http://localhost")
        headers = {**how.pop("headers", {}), "Authorization": f"Bearer {token}"}
        known = {name: how[name] for name in ("params", "json", "data", "files") if how.get(name)}
        if isinstance(known.get("data"), bytes | str):
            known["content"] = known.pop("data")
        try:
            request = program.build_request(how["method"], how["url"], headers=headers, **known)
        except (ValueError, TypeError, UnicodeError):  # what no client can send
            return
        check(case, program.send(request))

    one()


def fuzzed(shop: Shop, often: int) -> int:
    """Ask every address as nobody, as a reader and as an administrator; how many addresses there were."""

    def refused(_: Any, answer: Any) -> None:
        assert answer.status_code in (303, 401, 404, 405, 400, 413, 414, 431), answer.request.url

    found = operations(shop)
    before = shop.head()
    for operation in found:
        if operation.definition.raw["x-role"] != ANYBODY:
            asked(shop, operation, "egt_nobody", often, refused)
    assert shop.head() == before
    for role in (READER, ENGINEER):
        for operation in found:
            needed = operation.definition.raw["x-role"]
            if ROLES.index(needed) > ROLES.index(role):
                asked(shop, operation, shop.tokens[role], often, _check_refused)
    assert shop.head() == before
    for operation in found:
        if operation.path not in OWN:
            asked(shop, operation, shop.tokens[ADMINISTRATOR], often, _check_no_fault)
    assert shop.program(shop.tokens[ADMINISTRATOR]).get("http://localhost/fleet.json").status_code == 200
    assert shop.history.verify().faults == ()
    return len(found)


def _check_refused(case: Any, answer: Any) -> None:
    assert answer.status_code in (400, 403, 404, 405, 413, 414, 431), (case.path, answer.text)


def _check_no_fault(case: Any, answer: Any) -> None:
    assert answer.status_code < 500, (case.method, str(answer.request.url), answer.text)


def test_no_request_is_a_fault_and_nothing_is_written_without_the_role(own: Shop) -> None:
    assert fuzzed(own, SHORT) > 25


@pytest.mark.nightly
def test_no_request_of_many_is_a_fault(make_shop: Callable[..., Shop]) -> None:
    assert fuzzed(make_shop(hosts=()), LONG) > 25
