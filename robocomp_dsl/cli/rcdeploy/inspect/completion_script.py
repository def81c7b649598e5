"""`rcdeploy completion`: the script that a shell loads. In: the shell. Out: the script."""

from __future__ import annotations

import click

SHELLS = ("bash", "zsh", "fish")
_HELP = """Print the completion script of a shell.

bash: eval "$(rcdeploy completion bash)" in ~/.bashrc.
zsh: eval "$(rcdeploy completion zsh)" in ~/.zshrc, after compinit.
fish: rcdeploy completion fish > ~/.config/fish/completions/rcdeploy.fish
"""


@click.command(help=_HELP)
@click.argument("shell", type=click.Choice(SHELLS))
@click.pass_context
def command(context: click.Context, shell: str) -> None:
    """Print the completion script of a shell."""
    from click.shell_completion import get_completion_class  # noqa: PLC0415 - only here

    completion_class = get_completion_class(shell)
    assert completion_class is not None  # noqa: S101 - click knows these three
    root = context.find_root().command
    print(completion_class(root, {}, "rcdeploy", "_RCDEPLOY_COMPLETE").source())
