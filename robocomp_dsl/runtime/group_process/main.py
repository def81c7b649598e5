"""Main function of a group in one process: command line, logs, signals, exit code."""

from __future__ import annotations

import logging
import sys
from collections.abc import Sequence

from robocomp_dsl.runtime.component import logs
from robocomp_dsl.runtime.component.process_exit import exit_now
from robocomp_dsl.runtime.component.thread_context import (
    context_of,
    current_context,
    inherit_contexts,
)
from robocomp_dsl.runtime.entry_point import on_signals
from robocomp_dsl.runtime.group_process.arguments import parse_arguments
from robocomp_dsl.runtime.group_process.member_output import MemberOutput
from robocomp_dsl.runtime.group_process.running_group import RunningGroup


def main(argv: Sequence[str] | None = None) -> int:
    """Run a group until it stops or is stopped; returns the exit code of the process."""
    arguments = parse_arguments(sys.argv[1:] if argv is None else argv)

    def component_of(record: logging.LogRecord) -> str:
        """The component of a log record: that of its logger, or of the thread."""
        context = context_of(record.name) or current_context()
        return context.name if context else arguments.name

    logs.set_up(arguments.name, arguments.log_level, arguments.log_format, component_of)
    inherit_contexts()
    outputs: list[MemberOutput] = []
    if arguments.log_format == "json":
        sys.stdout, sys.stderr = outputs = [
            MemberOutput(sys.stdout, "stdout"),
            MemberOutput(sys.stderr, "stderr"),
        ]
    group = RunningGroup(arguments)
    on_signals(group.stop)
    code = group.run()
    for output in outputs:
        output.finish()
    if group.abandoned:
        exit_now(1)  # a thread of a member hangs
    return code
