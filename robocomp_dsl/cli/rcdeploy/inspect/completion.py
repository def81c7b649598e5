"""Shell completion of components, ports, operations and fields of a running deployment.

In: what is typed so far. Out: words. Completion never fails: without a deployment there are none.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import click

from robocomp_dsl.cli.rcdeploy.inspect.target import DomainTarget, resolve_domain

if TYPE_CHECKING:
    from robocomp_dsl.client import ComponentDescription, DescribedPort, DomainClient
    from robocomp_dsl.runtime.data.schema import Type

TIMEOUT_S = 0.5
"""A component that hangs is left out."""
_MAX_DEPTH = 3


Completer = Callable[[click.Context, click.Parameter, str], list[Any]]


def complete_ports(*roles: str, level: str) -> Completer:
    """Completion of a port with one of `roles`; `level`: port, operation or field."""

    def complete(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[Any]:
        del param
        return complete_target(ctx.params, incomplete, roles, level)

    return complete


def complete_components(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[Any]:
    """Completion of a component."""
    del param
    return [name for name in component_names(ctx.params) if name.startswith(incomplete)]


def component_names(options: Mapping[str, Any]) -> list[str]:
    """The components of the deployment; empty if there is none."""
    try:
        domain_target = _domain_of(options)
        if domain_target.components:
            return list(domain_target.components)
        from robocomp_dsl.client import DomainClient  # noqa: PLC0415 - loads numpy

        with DomainClient(domain_target.domain, name="rcdeploy") as client:
            return client.components(TIMEOUT_S)
    except Exception:  # a shell has no place for an error message
        return []


def _domain_of(options: Mapping[str, Any]) -> DomainTarget:
    return resolve_domain(options.get("deployment"), options.get("domain"))


def complete_target(
    options: Mapping[str, Any], incomplete: str, roles: Sequence[str], level: str
) -> list[str]:
    """Words that begin with `incomplete`; `level`: port, operation or field."""
    try:
        from robocomp_dsl.client import DomainClient  # noqa: PLC0415 - loads numpy

        domain_target = _domain_of(options)
        with DomainClient(domain_target.domain, name="rcdeploy") as client:
            components = domain_target.components or client.components(TIMEOUT_S)
            found = _describe(client, [c for c in components if _begins(c, incomplete)])
            words = [
                word for component in found for word in _words(component, incomplete, roles, level)
            ]
    except Exception:  # a shell has no place for an error message
        return []
    return words


def _begins(component: str, incomplete: str) -> bool:
    """Whether `incomplete` is the beginning of the component or of something in it."""
    return component.startswith(incomplete) or incomplete.startswith(f"{component}.")


def _describe(client: DomainClient, names: Sequence[str]) -> list[ComponentDescription]:
    """Those components that answer in time."""
    found: dict[str, ComponentDescription] = {}

    def describe(name: str) -> None:
        try:
            found[name] = client.describe(name, TIMEOUT_S)
        except Exception:
            return

    threads = [threading.Thread(target=describe, args=(name,), daemon=True) for name in names]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(TIMEOUT_S)
    return [found[name] for name in names if name in found]


def _words(
    component: ComponentDescription, incomplete: str, roles: Sequence[str], level: str
) -> Iterator[str]:
    ports = [port for port in component.ports if port.role in roles]
    matching = []
    for port in ports:
        name = f"{component.name}.{port.name}"
        if name.startswith(incomplete) or incomplete.startswith(f"{name}."):
            matching.append((name, port))
            if name.startswith(incomplete):
                yield name
    # With a single port, what follows it is offered, too: the shell then appends no space.
    if level != "port" and len(matching) == 1:
        name, port = matching[0]
        yield from (
            word for word in _inside(name, port, incomplete, level) if word.startswith(incomplete)
        )


def _inside(name: str, port: DescribedPort, incomplete: str, level: str) -> Iterator[str]:
    """Operations, and fields of their messages down to the depth that is typed."""
    operations = port.interface.operations
    if level == "operation" or len(operations) > 1:
        yield from (f"{name}.{operation.name}" for operation in operations)
    if level == "field":
        depth = min(incomplete.removeprefix(name).count(".") + 1, _MAX_DEPTH)
        for operation in operations:
            prefixes = [f"{name}.{operation.name}"]
            prefixes += [name] if len(operations) == 1 else []
            for prefix in prefixes:
                fields = operation.inputs
                if len(fields) == 1:
                    yield from _fields(prefix, fields[0][1], depth)
                else:
                    yield from (f"{prefix}.{field}" for field, _ in fields)


def _fields(prefix: str, type_: Type, depth: int) -> Iterator[str]:
    fields = getattr(type_, "_fields_", None)
    if not fields or not depth:
        return
    for name, inner in fields:
        yield f"{prefix}.{name}"
        yield from _fields(f"{prefix}.{name}", inner, depth - 1)
