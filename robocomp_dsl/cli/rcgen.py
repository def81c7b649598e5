"""`rcgen`: checks descriptions and generates components.

In: the command line. Out: an exit code.
"""

from __future__ import annotations

import click

from robocomp_dsl import __version__
from robocomp_dsl.cli.program import LazyGroup, run

TABLE = {
    "component": ("component", "Generate a component from its CDSL file."),
    "interface": ("interface", "Write an interface as Slice, as ROS 2 messages or as JSON Schema."),
    "simulator": ("simulator", "Generate a simulator from a world: its devices are served."),
    "hardware": ("hardware", "Generate the real twin of a simulated device: fill in its driver."),
    "view": ("view", "Show a world or a robot in the browser, or make a picture of it."),
    "check": ("check", "Check descriptions; the exit code is 1 if there are errors."),
    "doc": ("doc", "Write linked documentation of interfaces, components and deployments."),
    "fmt": ("fmt", "Format descriptions; nothing that they say changes."),
    "new": ("new", "Begin a new component: a commented CDSL and PDSL file."),
    "migrate": ("migrate", "Move an existing RoboComp component or deployment over."),
    "breaking": ("breaking", "List what a change breaks: peers, code, configurations."),
    "config": ("config", "List, import and compare the configurations of contexts."),
    "lsp": ("lsp", "Serve an editor: findings as you type, completion, navigation."),
    "explain": ("explain", "Say what a code such as RC204 means."),
}

program = LazyGroup(
    "rcgen",
    table=TABLE,
    help="Describe robot components in small languages; check them, generate them.",
)
click.version_option(__version__, prog_name="rcgen")(program)


def main() -> None:
    """Entry point of the command."""
    run(program, "rcgen")
