"""Calls of the interface `Component`, which components of every version serve.

In: a component's name. Out: its proxy; a refusal becomes a message.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect.target import (
    CALL_TIMEOUT_S,
    DomainTarget,
    open_client,
    resolve_domain,
)

if TYPE_CHECKING:
    from robocomp_dsl.client import DomainClient
    from robocomp_dsl.runtime.component.component_interface import ComponentProxy


@contextmanager
def component_proxy(
    name: str, deployment: str | None, domain: str | None
) -> Iterator[tuple[ComponentProxy, str]]:
    """The proxy of a component, and its full name. Raises `CliError`."""
    domain_target = resolve_domain(deployment, domain)
    full_name = domain_target.component(name)
    with open_client(domain_target) as client:
        from robocomp_dsl.runtime.component.component_interface import Refusal  # noqa: PLC0415

        try:
            yield connect(client, full_name), full_name
        except Refusal as refusal:
            raise CliError(EXIT_FINDINGS, f"`{full_name}` refuses: {refusal.reason}") from None


def connect(
    client: DomainClient, component: str, timeout: float = CALL_TIMEOUT_S
) -> ComponentProxy:
    """The proxy of a component that answers. Raises `CliError`."""
    proxy = client.component(component)
    proxy.set_timeout(timeout)
    if not proxy.wait_for_server(timeout):
        raise CliError(
            EXIT_FINDINGS,
            f"`{component}` does not answer within {timeout:g} s; see `rcdeploy status`",
        )
    return proxy


def component_names(client: DomainClient, domain_target: DomainTarget) -> tuple[str, ...]:
    """The components of the deployment, or those that are seen in the domain."""
    if domain_target.deployment:
        return domain_target.components
    return domain_target.components or tuple(client.components())
