"""`rcdeploy call`: calls an operation. In: an operation, its arguments as YAML. Out: the result."""

from __future__ import annotations

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_ports
from robocomp_dsl.cli.rcdeploy.inspect.target import (
    CALL_TIMEOUT_S,
    InspectCommand,
    open_client,
    resolve_domain,
    resolve_port,
    split_operation,
)


@click.command(cls=InspectCommand, context_settings={"ignore_unknown_options": True})
@click.argument(
    "target",
    metavar="COMPONENT.PORT.OPERATION",
    shell_complete=complete_ports("implements", level="operation"),
)
@click.argument("arguments", nargs=-1, metavar="[YAML]...", type=click.UNPROCESSED)
@click.option("--json", "as_json", is_flag=True, help="Print the result as JSON.")
@click.option(
    "--timeout",
    default=CALL_TIMEOUT_S,
    type=click.FloatRange(0, min_open=True),
    metavar="S",
    help="Wait so long for the reply. Default: 5.",
)
def command(
    target: str,
    arguments: tuple[str, ...],
    *,
    as_json: bool,
    timeout: float,
    deployment: str | None,
    domain: str | None,
) -> None:
    """Call an operation of an implemented port and print its result."""
    from robocomp_dsl.cli.rcdeploy.inspect import text  # noqa: PLC0415
    from robocomp_dsl.cli.rcdeploy.inspect.arguments import parse_arguments  # noqa: PLC0415
    from robocomp_dsl.client import result_to_plain, struct_to_plain  # noqa: PLC0415
    from robocomp_dsl.diagnostics import did_you_mean  # noqa: PLC0415
    from robocomp_dsl.runtime.errors import DeclaredError  # noqa: PLC0415

    domain_target = resolve_domain(deployment, domain)
    with open_client(domain_target) as client:
        found = resolve_port(client, domain_target, target, "implements")
        name, rest = split_operation(found)
        port = found.port
        if not name or rest:
            names = [operation.name for operation in port.interface.operations]
            hint = did_you_mean(found.rest, names) or f"it has {', '.join(names)}"
            problem = f"has no operation `{found.rest}`" if found.rest else "needs an operation"
            raise CliError(EXIT_FINDINGS, f"`{found.component}.{port.name}` {problem}; {hint}")
        operation = port.interface.operation(name)
        words = parse_arguments(
            operation, port.operation_info(name), arguments, f"rcdeploy call {target}"
        )
        channel = client.channel(port.interface, found.component, port.name)
        channel.timeout = timeout
        try:
            result = channel.bind(operation)(*words)
        except DeclaredError as error:
            fields = text.to_json(struct_to_plain(error))
            raise CliError(
                EXIT_FINDINGS, f"`{target}` raised {type(error).__name__} {fields}"
            ) from None
        if operation.outputs:
            plain = result_to_plain(operation, result)
            print(text.to_json(plain) if as_json else text.to_yaml(plain))
