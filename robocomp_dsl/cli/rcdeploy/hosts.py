"""`rcdeploy hosts`: what the hosts of a deployment are, and which of their keys are confirmed."""

from __future__ import annotations

import click

from robocomp_dsl.cli.program import LazyGroup

TABLE = {
    "show": ("rcdeploy.hosts_show", "Check the hosts of a deployment, and show what they are."),
    "trust": ("rcdeploy.hosts_trust", "Confirm the SSH keys of hosts."),
}


class HostsGroup(LazyGroup):
    """`hosts APP.ddsl` is `hosts show APP.ddsl`, and `hosts APP.ddsl trust` the other command."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """As in click, with the command first."""
        words = [word for word in args if not word.startswith("-")]
        if words and words[0].lower().endswith(".ddsl"):
            command_name = words[1] if words[1:] and words[1] in self.table else "show"
            if command_name in words:
                args.remove(command_name)
            args.insert(0, command_name)
        return super().parse_args(ctx, args)


command = HostsGroup(
    "hosts",
    table=TABLE,
    help="Check the hosts of a deployment. `rcdeploy hosts app.ddsl` shows what they are: systemd, "
    "Python, space, load, and how far their clocks are off. It changes nothing.",
)
