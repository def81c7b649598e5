"""`rcgen`: the table of its commands. In: the command line. Out: an exit code."""

from __future__ import annotations

import click

from robocomp_dsl import __version__
from robocomp_dsl.cli.program import LazyGroup, run

TABLE = {
    "component": ("rcgen.component", "Generate a component from its CDSL file."),
    "bridge": (
        "rcgen.bridge",
        "Generate a bridge between middlewares from its BDSL file.",
    ),
    "interface": (
        "rcgen.interface",
        "Export an interface as Slice, ROS 2 messages or JSON Schema.",
    ),
    "simulator": (
        "rcgen.simulation.simulator",
        "Generate a simulator component from a world; it serves the devices of the world.",
    ),
    "hardware": (
        "rcgen.simulation.hardware",
        "Generate a component for a real device like a simulated one; you write the driver.",
    ),
    "view": (
        "rcgen.simulation.view",
        "Show a world, a robot or a running simulation in the browser, or save a screenshot.",
    ),
    "check": ("rcgen.check", "Check description files; the exit code is 1 if there are errors."),
    "doc": (
        "rcgen.doc",
        "Generate documentation of interfaces, components and deployments.",
    ),
    "fmt": ("rcgen.fmt", "Format description files; their meaning does not change."),
    "new": ("rcgen.new", "Start a new component, or copy an example with `--example`."),
    "examples": ("rcgen.examples", "List the components, robots and demos that ship."),
    "migrate": ("rcgen.migrate", "Migrate existing RoboComp components and deployments."),
    "breaking": (
        "rcgen.breaking",
        "List breaking changes for peers, code, configurations, deployments.",
    ),
    "config": ("rcgen.config.group", "List, import and compare configuration contexts."),
    "lsp": (
        "rcgen.lsp",
        "Start the language server for editors: diagnostics, completion, navigation.",
    ),
    "explain": ("rcgen.explain", "Explain a finding code such as RC204."),
}

program = LazyGroup(
    "rcgen",
    table=TABLE,
    help="Check descriptions of robot components and generate code from them.",
)
click.version_option(__version__, prog_name="rcgen")(program)


def main() -> None:
    """Entry point of the command."""
    run(program, "rcgen")
