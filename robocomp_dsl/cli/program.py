"""Runs the commands: lazy loading of sub-commands, error messages and exit codes.

In: a table of sub-commands. Out: a click group, and `run`, the only exit of the process with code 0
(success), 1 (findings), 2 (usage), 70 (internal error), 130 (Ctrl-C), 141 (broken pipe) or 143
(SIGTERM).
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from contextlib import suppress
from importlib import import_module
from types import TracebackType
from typing import Any, NoReturn

import click

from robocomp_dsl.extras import MissingExtra

EXIT_FINDINGS = 1
EXIT_USAGE = 2
EXIT_SOFTWARE = 70
EXIT_INTERRUPTED = 130
EXIT_BROKEN_PIPE = 141
EXIT_TERMINATED = 143
GC_GEN0_THRESHOLD = 20_000
"""New objects before a garbage collection; commands create few reference cycles."""
DEBUG = "ROBOCOMP_DEBUG"


class CliError(Exception):
    """Ends the command with exit code `code`; `run` prints `message`, if any, to stderr."""

    def __init__(self, code: int, message: str = "") -> None:
        super().__init__(message)
        self.code = code


class LazyGroup(click.Group):
    """A group whose sub-commands are modules of `robocomp_dsl.cli`, each with a `command`.

    `table` maps the name of a command to its module and its line in `--help`. The help loads no
    module.
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
        """As in click, but suggests the nearest name for an unknown command."""
        if args and not args[0].startswith("-") and args[0] not in self.table:
            from robocomp_dsl.diagnostics import did_you_mean  # noqa: PLC0415 - not for --help

            guess = did_you_mean(args[0], self.table)
            ctx.fail(f"no command `{args[0]}`" + (f"; {guess}" if guess else ""))
        return super().resolve_command(ctx, args)

    def invoke(self, ctx: click.Context) -> Any:
        """As in click, but a broken pipe ends the command; remaining output is discarded."""
        try:
            try:
                return super().invoke(ctx)
            finally:
                sys.stdout.flush()
        except BrokenPipeError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            raise CliError(EXIT_BROKEN_PIPE) from None

    def format_commands(
        self,
        ctx: click.Context,  # noqa: ARG002 - as click calls it
        formatter: click.HelpFormatter,
    ) -> None:
        """The lines of the table."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, about) for name, (_, about) in self.table.items()])


def terminal_width() -> int:
    """Columns for help texts; computed here, because click's own way loads slow modules."""
    columns = os.environ.get("COLUMNS", "")
    if columns.isdigit() and int(columns):
        return int(columns)
    try:
        return os.get_terminal_size(sys.stdout.fileno()).columns
    except (OSError, ValueError, AttributeError):
        return 80


def run(program: click.Command, name: str) -> NoReturn:
    """Run `program` on the command line and exit the process with its exit code."""
    signal.signal(signal.SIGTERM, _terminated)
    # Python does so itself, except in a background process of a script with SIGINT ignored.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    gc.set_threshold(GC_GEN0_THRESHOLD)
    try:
        sys.exit(_exit_code(program, name))
    finally:
        gc.freeze()  # avoids a last full collection when the interpreter exits


def _exit_code(program: click.Command, name: str) -> int:
    try:
        code: object = program.main(prog_name=name, standalone_mode=False)
    except click.exceptions.Exit as request:
        code = request.exit_code
    except click.ClickException as error:
        error.show()
        code = error.exit_code
    except CliError as error:
        _print_message(error)
        code = error.code
    except (click.Abort, KeyboardInterrupt):
        print(f"{name}: interrupted", file=sys.stderr)
        code = EXIT_INTERRUPTED
    except SystemExit:
        raise
    except MissingExtra as error:
        _print_message(error)
        code = EXIT_FINDINGS
    except BaseException as error:
        if os.environ.get(DEBUG):
            raise
        print(bug_report(name, error), file=sys.stderr)
        code = EXIT_SOFTWARE
    return code if isinstance(code, int) else 0


def _print_message(error: Exception) -> None:
    if message := str(error):
        from robocomp_dsl.cli.options import print_error  # noqa: PLC0415 - only for errors

        with suppress(OSError):  # the exit code says it, too
            print_error(message)


def bug_report(name: str, error: BaseException) -> str:
    """An internal error in one line: the exception, its location, and how to get the traceback."""
    message = " ".join(str(error).split())[:200]
    cause = f"{type(error).__name__}: {message}" if message else type(error).__name__
    return (
        f"{name}: internal error, please report it: {cause} at {_location(error.__traceback__)} "
        f"({DEBUG}=1 shows the whole traceback)"
    )


def _location(trace: TracebackType | None) -> str:
    """The innermost frame of this package in the traceback."""
    location = "unknown location"
    package = f"{os.sep}robocomp_dsl{os.sep}"
    while trace:
        file = trace.tb_frame.f_code.co_filename
        if package in file:
            location = f"robocomp_dsl/{file.rpartition(package)[2]}:{trace.tb_lineno}"
        trace = trace.tb_next
    return location


def _terminated(*_: object) -> NoReturn:
    # Raises SystemExit, so that partially written files are rolled back.
    sys.exit(EXIT_TERMINATED)
