"""Checks whether the middlewares of a deployment can be used on this machine.

In: a deployment. Out: findings, each at the first component that uses the middleware.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.deploy import codes
from robocomp_dsl.diagnostics import Diagnostic
from robocomp_dsl.model.connection_index import ConnectionIndex
from robocomp_dsl.model.deployment import Deployment, Instance
from robocomp_dsl.model.port_middlewares import IN_PROCESS, port_middlewares
from robocomp_dsl.runtime.middleware.registry import missing_modules


def check_middlewares(deployment: Deployment, known: KnownMiddlewares) -> Iterator[Diagnostic]:
    """Middlewares that cannot connect processes, or whose modules are not installed."""
    for name, instance in _first_users(deployment).items():
        description = known.describe(name)
        if description is None:
            message = f"`{instance.name}`: {known.problem(name)}"
            yield Diagnostic(codes.MIDDLEWARE, instance.span, message)
        elif not description.capabilities.between_processes:
            message = f"`{instance.name}` uses the middleware `{name}`, which cannot connect "
            help_text = "choose another middleware: `middleware zenoh;`"
            message += "processes"
            yield Diagnostic(codes.MIDDLEWARE, instance.span, message, help=help_text)
        elif missing := missing_modules(description):
            message = f"`{instance.name}` uses the middleware `{name}`, which needs "
            message += f"{', '.join(f'`{module}`' for module in missing)}"
            yield Diagnostic(codes.MIDDLEWARE, instance.span, message, help=description.install)


def _first_users(deployment: Deployment) -> dict[str, Instance]:
    """The middlewares of local components, each with the first instance that uses it."""
    users: dict[str, Instance] = {}
    index = ConnectionIndex(deployment.connections)
    for instance in deployment.instances:
        for port in instance.component.ports if instance.host.is_local else ():
            for name in port_middlewares(instance, port, index.at(instance), deployment.middleware):
                if not (instance.process and name == IN_PROCESS):
                    users.setdefault(name, instance)
    return users
