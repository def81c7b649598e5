"""`rcdeploy echo`: what a component publishes. In: a port or a field of it. Out: its messages."""

from __future__ import annotations

import click

from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_ports
from robocomp_dsl.cli.rcdeploy.inspect.target import (
    InspectCommand,
    open_client,
    resolve_domain,
    resolve_port,
    split_operation,
)


@click.command(cls=InspectCommand)
@click.argument(
    "target",
    metavar="COMPONENT.PORT[.FIELD]",
    shell_complete=complete_ports("publishes", level="field"),
)
@click.option("--once", is_flag=True, help="Print one message.")
@click.option("-n", "count", type=click.IntRange(1), help="Print so many messages.")
@click.option("--csv", "form", flag_value="csv", help="One row per message.")
@click.option("--json", "form", flag_value="json", help="One JSON value per line and message.")
@click.option("--full", is_flag=True, help="Print lists of any length.")
def command(
    target: str,
    *,
    once: bool,
    count: int | None,
    form: str | None,
    full: bool,
    deployment: str | None,
    domain: str | None,
) -> None:
    """Print the messages of a published port, or one field of them, until Ctrl-C."""
    from robocomp_dsl.cli.rcdeploy.inspect import field_paths, messages, text  # noqa: PLC0415 - numpy

    domain_target = resolve_domain(deployment, domain)
    with open_client(domain_target) as client:
        found = resolve_port(client, domain_target, target, "publishes")
        name, path = split_operation(found)
        operations = messages.published_operations(found, name)
        column = len(target) - len(path)
        if path and len(operations) > 1:
            names = ", ".join(operation.name for operation in operations)
            raise click.UsageError(f"the port has the operations {names}; write {target[:column]}"
                                   f"{operations[0].name}.{path}")  # fmt: skip
        select = {
            each.name: field_paths.select_field(each.inputs, path, target, column)
            for each in operations
        }
        rows = text.CsvWriter()
        stream = messages.MessageStream(client, found, operations)
        limit = 1 if once else count
        try:
            for number, message in enumerate(stream, 1):
                value = select[message.operation](message.arguments)
                if len(operations) > 1:
                    value = {"operation": message.operation, "message": value}
                if form == "json":
                    print(text.to_json(value), flush=True)
                elif form == "csv":
                    print(rows.rows(_with_time(message.time, value)), end="", flush=True)
                else:
                    separator = "" if number == limit == 1 else "\n---"
                    print(text.to_yaml(value, full=full) + separator, flush=True)
                if number == limit:
                    break
        finally:
            stream.report_lost()


def _with_time(time: float, value: object) -> dict[str, object]:
    fields = value if isinstance(value, dict) else {"value": value}
    return {"time": round(time, 6), **fields}
