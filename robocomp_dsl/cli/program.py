"""How the commands run: sub-commands loaded when they are called, exits and failures of a program.

In: a table of sub-commands. Out: a click group, and `run`, which turns everything that can happen
into an exit code: 0 clean, 1 findings, 2 usage, 70 a mistake of ours, 130 Ctrl-C, 141 nobody reads
the output any more, 143 SIGTERM.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from importlib import import_module
from types import TracebackType
from typing import Any, NoReturn

import click

FINDINGS = 1
USAGE = 2
OUR_MISTAKE = 70
INTERRUPTED = 130
NO_READER = 141
TERMINATED = 143
YOUNG = 20_000
"""New objects before the garbage collector looks through them; a command makes few that become
garbage in circles."""
DEBUG = "ROBOCOMP_DEBUG"


class LazyGroup(click.Group):
    """A group whose sub-commands are modules of this package, each with a `command`.

    `table` has the name, the module and the line for `--help` of each, so that help loads none.
    """

    def __init__(self, *args: Any, table: dict[str, tuple[str, str]], **kwargs: Any) -> None:
        settings = {"help_option_names": ["-h", "--help"], "terminal_width": terminal_width()}
        super().__init__(*args, context_settings=settings, **kwargs)
        self.table = table

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - as click calls it
        """In the order of the table."""
        return list(self.table)

    def get_command(
        self,
        ctx: click.Context,  # noqa: ARG002 - as click calls it
        cmd_name: str,
    ) -> click.Command | None:
        """The sub-command, loaded now."""
        if cmd_name not in self.table:
            return None
        module = import_module(f"robocomp_dsl.cli.{self.table[cmd_name][0]}")
        command: click.Command = module.command
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """As click does, with the nearest name for an unknown one."""
        if args and not args[0].startswith("-") and args[0] not in self.table:
            from robocomp_dsl.diagnostics import did_you_mean  # noqa: PLC0415 - not for --help

            guess = did_you_mean(args[0], self.table)
            ctx.fail(f"no command `{args[0]}`" + (f"; {guess}" if guess else ""))
        return super().resolve_command(ctx, args)

    def invoke(self, ctx: click.Context) -> Any:
        """As click does; when nobody reads the output any more, the rest of it goes nowhere."""
        try:
            try:
                return super().invoke(ctx)
            finally:
                sys.stdout.flush()
        except BrokenPipeError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            ctx.exit(NO_READER)

    def format_commands(
        self,
        ctx: click.Context,  # noqa: ARG002 - as click calls it
        formatter: click.HelpFormatter,
    ) -> None:
        """The lines of the table."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, about) for name, (_, about) in self.table.items()])


def terminal_width() -> int:
    """Columns for help texts; asked here, because what click asks takes long to load."""
    given = os.environ.get("COLUMNS", "")
    if given.isdigit() and int(given):
        return int(given)
    try:
        return os.get_terminal_size(sys.stdout.fileno()).columns
    except (OSError, ValueError, AttributeError):
        return 80


def run(program: click.Command, name: str) -> NoReturn:
    """Run `program` on the command line and leave the process with its exit code."""
    signal.signal(signal.SIGTERM, _terminated)
    gc.set_threshold(YOUNG)
    try:
        sys.exit(_exit_code(program, name))
    finally:
        gc.freeze()  # or the interpreter looks through everything once more before it ends


def _exit_code(program: click.Command, name: str) -> int:
    try:
        code = program.main(prog_name=name, standalone_mode=False)
    except click.exceptions.Exit as leaving:
        return leaving.exit_code
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except (click.Abort, KeyboardInterrupt):
        print(f"{name}: interrupted", file=sys.stderr)
        return INTERRUPTED
    except SystemExit:
        raise
    except BaseException as error:
        if os.environ.get(DEBUG):
            raise
        print(bug_report(name, error), file=sys.stderr)
        return OUR_MISTAKE
    return code if isinstance(code, int) else 0


def bug_report(name: str, error: BaseException) -> str:
    """A mistake of ours in one line: what, where in our code, and how to see more."""
    said = " ".join(str(error).split())[:200]
    what = f"{type(error).__name__}: {said}" if said else type(error).__name__
    return (
        f"{name}: internal error, please report it: {what} at {_place(error.__traceback__)} "
        f"({DEBUG}=1 shows the whole trace)"
    )


def _place(trace: TracebackType | None) -> str:
    """The innermost place in this package that the exception went through."""
    found = "unknown place"
    package = f"{os.sep}robocomp_dsl{os.sep}"
    while trace:
        file = trace.tb_frame.f_code.co_filename
        if package in file:
            found = f"robocomp_dsl/{file.rpartition(package)[2]}:{trace.tb_lineno}"
        trace = trace.tb_next
    return found


def _terminated(*_: object) -> NoReturn:
    # An exception, so that half-written files are taken back on the way out.
    sys.exit(TERMINATED)
