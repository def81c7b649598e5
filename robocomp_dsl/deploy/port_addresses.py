"""Checks the addresses that a deployment chooses for ports of its components.

In: a deployment. Out: findings about TCP ports of this machine that two components want, or that
another process has.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib import import_module

from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.deploy import codes
from robocomp_dsl.diagnostics import Diagnostic, Note
from robocomp_dsl.model.deployment import Deployment, Instance


def check_port_addresses(
    deployment: Deployment, known: KnownMiddlewares, bind_error: Callable[[int], str]
) -> Iterator[Diagnostic]:
    """Ports that cannot be used; `bind_error` tells why one cannot be bound, or is empty."""
    users: dict[int, Instance] = {}
    for instance in deployment.instances:
        numbers = dict(_tcp_ports(instance, known)) if instance.host.is_local else {}
        for number, port in numbers.items():
            first = users.setdefault(number, instance)
            if first is not instance:
                message = f"`{instance.name}.{port}`: `{first.name}` has TCP port {number}, too"
                notes = (Note(first.span, "declared here"),)
                yield Diagnostic(codes.PORT_TAKEN, instance.span, message, notes=notes)
            elif reason := bind_error(number):
                message = f"`{instance.name}.{port}`: TCP port {number} cannot be used: {reason}"
                yield Diagnostic(codes.PORT_TAKEN, instance.span, message)


def _tcp_ports(instance: Instance, known: KnownMiddlewares) -> Iterator[tuple[int, str]]:
    """The fixed TCP ports of an instance, each with the port that listens there."""
    for port in instance.own_ports:
        description = known.describe(port.middleware) if port.address else None
        if description is not None and description.tcp_ports:
            module, _, function = description.tcp_ports.partition(":")
            for number in getattr(import_module(module), function)(port.address):
                yield number, port.port
