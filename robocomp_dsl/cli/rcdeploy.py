"""`rcdeploy`: runs deployments. In: the command line. Out: an exit code.

0: stopped on request, or all components ended well; 1: findings, or a component failed; 2: usage.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

import click

from robocomp_dsl import __version__
from robocomp_dsl.cli.program import LazyGroup, run

TABLE = {
    "up": ("rcdeploy_up", "Run it here, in the foreground; Ctrl-C stops it in order."),
    "plan": ("rcdeploy_plan", "Show what would be started, and how."),
    "check": ("rcdeploy_check", "Check everything, start nothing."),
    "status": ("rcdeploy_status", "The components of a running deployment."),
    "logs": ("rcdeploy_logs", "What the components of a running deployment said."),
    "param": ("rcdeploy_param", "Read and change parameters of running components."),
    "stop": ("rcdeploy_stop", "Stop a running deployment and wait for its end."),
}

program = LazyGroup(
    "rcdeploy",
    table=TABLE,
    help="Run a deployment: `rcdeploy app.ddsl` starts all its components on this machine and "
    "shows what they say. A command may also stand behind the file: `rcdeploy app.ddsl status`.",
)
click.version_option(__version__, prog_name="rcdeploy")(program)


def ordered(arguments: Sequence[str]) -> list[str]:
    """`app.ddsl status -f` as `status app.ddsl -f`, and `app.ddsl` alone as `up app.ddsl`.

    What stands behind the file is taken for a command even if it is none, so that this is said.
    """
    words = list(arguments)
    if not words or words[0] in TABLE or not any(w.lower().endswith(".ddsl") for w in words):
        return words
    behind = 1 + next(i for i, word in enumerate(words) if word.lower().endswith(".ddsl"))
    if words[behind:] and not words[behind].startswith("-"):
        return [words[behind], *words[:behind], *words[behind + 1 :]]
    return ["up", *words]


def main() -> None:
    """Entry point of the command."""
    sys.argv[1:] = ordered(sys.argv[1:])
    run(program, "rcdeploy")
