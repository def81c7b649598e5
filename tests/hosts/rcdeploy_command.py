"""`rcdeploy` in the process of a test. In: its arguments. Out: exit code and output."""

from __future__ import annotations

from dataclasses import dataclass

from click.testing import CliRunner

from robocomp_dsl.cli.program import CliError
from robocomp_dsl.cli.rcdeploy.main import normalise_arguments, program


@dataclass(frozen=True)
class CommandOutcome:
    code: int
    stdout: str
    stderr: str


def rcdeploy(*words: str) -> CommandOutcome:
    result = CliRunner().invoke(program, normalise_arguments(words))
    code, stderr = result.exit_code, result.stderr
    if isinstance(result.exception, CliError):
        code, stderr = result.exception.code, f"{stderr}{result.exception}"
    elif result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception
    return CommandOutcome(code, result.stdout, stderr)
