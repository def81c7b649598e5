"""What a command looks at: a deployment or a domain, a component, a port of it.

In: `-d`, `--domain` and words such as `arm.Feed.pose[0].x`. Out: an open client and the port, or a
`CliError` that lists what there is.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from robocomp_dsl.cli.program import EXIT_BROKEN_PIPE, EXIT_FINDINGS, EXIT_INTERRUPTED, CliError

if TYPE_CHECKING:
    from robocomp_dsl.client import ComponentDescription, DescribedPort, DomainClient
    from robocomp_dsl.deploy.engine import Engine

CALL_TIMEOUT_S = 5.0
ROLE_NAMES = {
    "implements": "implemented",
    "requires": "required",
    "publishes": "published",
    "subscribesTo": "subscribed",
}


class InspectCommand(click.Command):
    """A command with `-d` and `--domain`.

    A first word that is a DDSL file, or names a running deployment, is that of `-d`.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.params += [
            click.Option(
                ["-d", "--deployment"],
                metavar="NAME|APP.ddsl",
                help="Which deployment, if several are running.",
            ),
            click.Option(["--domain"], metavar="NAME", help="A domain without a deployment."),
        ]

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """As in click."""
        if args and (args[0].lower().endswith(".ddsl") or _begins_with_name(args)):
            args = ["--deployment", *args]
        return super().parse_args(ctx, args)


def _begins_with_name(args: Sequence[str]) -> bool:
    """Whether the first word names a running deployment, and no option does."""
    if args[0].startswith("-") or any(a.startswith(("-d", "--de", "--do")) for a in args):
        return False
    from robocomp_dsl.cli.rcdeploy import running  # noqa: PLC0415 - only for deployments

    return running.is_running(args[0])


@dataclass(frozen=True, slots=True)
class DomainTarget:
    """A domain; the others are known if rcdeploy runs a deployment in it.

    `path` is its DDSL file, `engine` what runs it.
    """

    domain: str
    components: tuple[str, ...] = ()
    deployment: str = ""
    path: str = ""
    engine: Engine | None = None

    def component(self, name: str) -> str:
        """The full name of a component. Raises `CliError`."""
        if not self.components:
            return name
        from robocomp_dsl.cli.rcdeploy import running  # noqa: PLC0415 - only for deployments

        return running.resolve_component(name, self.components)

    def split(self, target: str) -> tuple[str, str]:
        """`arm.Feed.x` as the full name of the component and the rest. Raises `CliError`."""
        known = {c.rpartition("/")[2] for c in self.components} | {*self.components}
        matches = [name for name in known if target == name or target.startswith(f"{name}.")]
        name = max(matches, key=len, default=target.partition(".")[0])
        return self.component(name), target[len(name) + 1 :]


def resolve_domain(deployment: str | None, domain: str | None) -> DomainTarget:
    """The domain that the options name. Raises `CliError` and `click.UsageError`."""
    if domain is not None:
        if deployment is not None:
            raise click.UsageError("use --deployment or --domain, not both")
        return DomainTarget(domain)
    from robocomp_dsl.cli.rcdeploy import running  # noqa: PLC0415 - only for deployments

    found = running.resolve_deployment(deployment)
    components = tuple(running.answering_components(found))
    return DomainTarget(found.domain, components, found.name, found.path, found)


@contextmanager
def open_client(domain_target: DomainTarget) -> Iterator[DomainClient]:
    """A client of the domain; its errors become messages, and Ctrl-C ends the command quietly."""
    from robocomp_dsl.client import DomainClient  # noqa: PLC0415 - loads numpy
    from robocomp_dsl.runtime.errors import MiddlewareError, Timeout  # noqa: PLC0415

    try:
        with DomainClient(domain_target.domain, name="rcdeploy") as client:
            yield client
            sys.stdout.flush()
    except Timeout as error:
        raise CliError(EXIT_FINDINGS, f"a component does not answer: {error}") from None
    except MiddlewareError as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    except KeyboardInterrupt:
        raise CliError(EXIT_INTERRUPTED) from None
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise CliError(EXIT_BROKEN_PIPE) from None


@dataclass(frozen=True, slots=True)
class PortTarget:
    """A port of a running component; `rest` are the operation and the field that follow it."""

    component: str
    description: ComponentDescription
    port: DescribedPort
    rest: str
    rest_column: int
    """Column of `rest` in the argument, from 0."""


def resolve_port(
    client: DomainClient, domain_target: DomainTarget, target: str, *roles: str
) -> PortTarget:
    """The port of `target` with one of `roles`. Raises `CliError` and `MiddlewareError`."""
    component, after = domain_target.split(target)
    description = client.describe(component, CALL_TIMEOUT_S)
    name = after.partition(".")[0].partition("[")[0]
    rest = after[len(name) :].removeprefix(".")
    try:
        port = description.port(name, *roles)
    except KeyError:
        raise CliError(EXIT_FINDINGS, _port_problem(description, name, roles)) from None
    return PortTarget(component, description, port, rest, len(target) - len(rest))


def _port_problem(description: ComponentDescription, name: str, roles: Sequence[str]) -> str:
    from robocomp_dsl.diagnostics import did_you_mean  # noqa: PLC0415 - only for errors

    usable = [port.name for port in description.ports if port.role in roles]
    kinds = " or ".join(ROLE_NAMES[role] for role in roles)
    listed = ", ".join(f"{description.name}.{port}" for port in usable) or "none"
    if other := next((p for p in description.ports if p.name == name), None):
        return (
            f"the port `{description.name}.{name}` is {ROLE_NAMES[other.role]}; this command takes"
            f" {kinds} ports: {listed}"
        )
    if not name:
        return f"which port of `{description.name}`? {kinds} ports: {listed}"
    hint = did_you_mean(name, usable)
    return f"`{description.name}` has no {kinds} port `{name}`; {hint or f'it has {listed}'}"


def split_operation(target: PortTarget) -> tuple[str, str]:
    """The operation that `rest` begins with, if any, and what follows it."""
    head = target.rest.partition(".")[0].partition("[")[0]
    names = {operation.name for operation in target.port.interface.operations}
    if head in names:
        return head, target.rest[len(head) :].removeprefix(".")
    return "", target.rest
