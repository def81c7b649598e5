"""Arguments of an operation, one word of YAML for each input.

In: words of the command line. Out: the tuple that the codec takes, or a `CliError`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from robocomp_dsl.cli.program import EXIT_USAGE, CliError
from robocomp_dsl.cli.rcdeploy.inspect.examples import example
from robocomp_dsl.cli.rcdeploy.inspect.type_names import signature
from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.dynamic.schema_interface import OperationInfo


def parse_arguments(
    operation: Operation, info: OperationInfo, words: Sequence[str], command: str
) -> tuple[Any, ...]:
    """The inputs of `operation`; `command` is what precedes them, for messages."""
    if len(words) != len(operation.inputs):
        examples = " ".join(f"'{example(type_)}'" for _, type_ in operation.inputs)
        count = len(operation.inputs)
        takes = f"takes {count} argument{'' if count == 1 else 's'}" if count else "takes none"
        raise CliError(
            EXIT_USAGE,
            f"{signature(info)} {takes}, and {len(words)} {'is' if len(words) == 1 else 'are'}"
            f" given; write {command} {examples}".rstrip(),
        )
    if not words:
        return ()
    from robocomp_dsl.cli.rcdeploy.inspect.yaml_values import parse_value  # noqa: PLC0415 - loads yaml

    return tuple(
        parse_value(type_, word, f"argument {position} (`{name}`)")
        for position, ((name, type_), word) in enumerate(
            zip(operation.inputs, words, strict=True), 1
        )
    )
