"""`rcdeploy`: runs deployments. In: the command line. Out: an exit code.

0: stopped on request, or all components succeeded; 1: findings, or a component failed; 2: usage.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

import click

from robocomp_dsl import __version__
from robocomp_dsl.cli.program import LazyGroup, run

TABLE = {
    "up": ("rcdeploy.up", "Run a deployment in the foreground; Ctrl-C stops it in order."),
    "keys": ("rcdeploy.keys", "Make the certificates of a deployment over hosts."),
    "plan": ("rcdeploy.plan", "Show which processes would be started, and how."),
    "export": ("rcdeploy.export", "Write a deployment for systemd, compose or Kubernetes."),
    "check": ("rcdeploy.check", "Check a deployment; start nothing."),
    "diff": ("rcdeploy.diff", "Compare what runs on hosts with the description."),
    "rollback": ("rcdeploy.rollback", "Run an earlier version of a deployment over hosts."),
    "status": ("rcdeploy.status", "Show the components of running deployments."),
    "logs": ("rcdeploy.logs", "Show the logs of a running deployment."),
    "list": ("rcdeploy.inspect.listing", "List ports, operations and types of components."),
    "echo": ("rcdeploy.inspect.echo", "Print what a component publishes."),
    "hz": ("rcdeploy.inspect.hz", "Measure how often a component publishes."),
    "bw": ("rcdeploy.inspect.bw", "Measure how many bytes a component publishes."),
    "call": ("rcdeploy.inspect.call", "Call an operation and print its result."),
    "pub": ("rcdeploy.inspect.pub", "Publish a message."),
    "stats": ("rcdeploy.inspect.stats", "Show calls, losses and times of components."),
    "loglevel": ("rcdeploy.inspect.loglevel", "Set the log level of a component."),
    "period": ("rcdeploy.inspect.period", "Set the period of a component."),
    "connections": ("rcdeploy.inspect.connections", "List the connections of components."),
    "connect": ("rcdeploy.inspect.connect", "Connect running components."),
    "disconnect": ("rcdeploy.inspect.disconnect", "Remove a connection of running components."),
    "remap": ("rcdeploy.inspect.remap", "Rename a port of a running component."),
    "qos": ("rcdeploy.inspect.qos", "Change the quality of service of a connection."),
    "param": ("rcdeploy.param", "Read and change parameters of running components."),
    "stop": ("rcdeploy.stop", "Stop a running deployment, or components of it."),
    "hosts": ("rcdeploy.hosts", "Check the hosts of a deployment, and confirm their SSH keys."),
    "start": ("rcdeploy.start", "Start components of a running deployment."),
    "restart": ("rcdeploy.restart", "Restart components of a running deployment."),
    "completion": ("rcdeploy.inspect.completion_script", "Print the completion script of a shell."),
}

program = LazyGroup(
    "rcdeploy",
    table=TABLE,
    help="Run a deployment: `rcdeploy app.ddsl` starts all its components on this machine and "
    "shows their logs. The command may follow the file: `rcdeploy app.ddsl status`.",
)
click.version_option(__version__, prog_name="rcdeploy")(program)


def normalise_arguments(arguments: Sequence[str]) -> list[str]:
    """`app.ddsl status -f` as `status app.ddsl -f`, and `app.ddsl` alone as `up app.ddsl`.

    The word after the file counts as a command even if it is unknown, so that this is reported. The
    file may also stand between `param` and its own command, or before both.
    """
    words = list(arguments)
    if words and words[0] not in TABLE:
        words = _command_first(words)
    if words[:1] == ["param"] and len(words) > 2 and _is_file(words[1]):
        words[1:3] = [words[2], words[1]]
    return words


def _command_first(words: list[str]) -> list[str]:
    if not any(map(_is_file, words)):
        return words
    command_index = 1 + next(i for i, word in enumerate(words) if _is_file(word))
    if words[command_index:] and not words[command_index].startswith("-"):
        return [words[command_index], *words[:command_index], *words[command_index + 1 :]]
    return ["up", *words]


def _is_file(word: str) -> bool:
    return word.lower().endswith(".ddsl")


def main() -> None:
    """Entry point of the command."""
    sys.argv[1:] = normalise_arguments(sys.argv[1:])
    run(program, "rcdeploy")
