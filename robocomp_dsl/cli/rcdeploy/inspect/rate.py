"""The rate and the bandwidth of a published port, measured in windows of one second.

In: a port. Out: a line per window. `rcdeploy hz` and `rcdeploy bw` differ in what they print.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from statistics import pstdev
from typing import Any

import click

from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_ports
from robocomp_dsl.cli.rcdeploy.inspect.target import (
    InspectCommand,
    open_client,
    resolve_domain,
    resolve_port,
    split_operation,
)

WINDOW_S = 1.0


@dataclass(frozen=True, slots=True)
class Window:
    """What arrived in `seconds`. `gaps`: s between two messages; `lost`: since the beginning."""

    seconds: float
    messages: int
    mean_bytes: float
    gaps: tuple[float, ...]
    lost: int

    def rate(self) -> dict[str, float]:
        """Messages per second, and the gaps between them in ms."""
        gaps = [1000 * gap for gap in self.gaps]
        mean = sum(gaps) / len(gaps) if gaps else 0.0
        return {
            "hz": round(1000 / mean if mean else self.messages / self.seconds, 3),
            "min_ms": round(min(gaps, default=0.0), 3),
            "max_ms": round(max(gaps, default=0.0), 3),
            "std_ms": round(pstdev(gaps) if gaps else 0.0, 3),
            "messages": self.messages,
            "lost": self.lost,
        }

    def bandwidth(self) -> dict[str, float]:
        """Bytes per second, and bytes per message."""
        return {
            "bytes_per_s": round(self.mean_bytes * self.messages / self.seconds, 1),
            "messages_per_s": round(self.messages / self.seconds, 3),
            "mean_bytes": round(self.mean_bytes, 1),
            "lost": self.lost,
        }


def measuring_command(
    function: Callable[[Window], dict[str, float]],
    text: Callable[[dict[str, float]], str],
    help_text: str,
) -> click.Command:
    """A command that prints `function` of each window as `text`, or as JSON."""

    def run(target: str, *, once: bool, as_json: bool, **options: Any) -> None:
        from robocomp_dsl.cli.rcdeploy.inspect.text import to_json  # noqa: PLC0415

        def show(window: Window) -> bool:
            figures = function(window)
            print(to_json(figures) if as_json else text(figures), flush=True)
            return once and bool(window.messages)

        _measure(target, show, **options)

    return InspectCommand(
        None,
        callback=run,
        help=help_text,
        params=[
            click.Argument(
                ["target"],
                metavar="COMPONENT.PORT[.OPERATION]",
                shell_complete=complete_ports("publishes", level="operation"),
            ),
            click.Option(["--once"], is_flag=True, help="Measure for one second."),
            click.Option(["--json", "as_json"], is_flag=True, help="One JSON object per line."),
        ],
    )


def _measure(
    target: str, show: Callable[[Window], bool], deployment: str | None, domain: str | None
) -> None:
    """Pass windows to `show` until it returns True."""
    from robocomp_dsl.cli.rcdeploy.inspect import messages  # noqa: PLC0415 - loads numpy

    domain_target = resolve_domain(deployment, domain)
    with open_client(domain_target) as client:
        found = resolve_port(client, domain_target, target, "publishes")
        operations = messages.published_operations(found, found.rest and split_operation(found)[0])
        stream = messages.MessageStream(client, found, operations)
        last: float | None = None
        while True:
            start = time.monotonic()
            messages_before, bytes_before = stream.received, stream.received_bytes
            count, gaps = 0, []
            while (left := start + WINDOW_S - time.monotonic()) > 0:
                message = stream.next(left)
                if message is None:
                    break
                count += 1
                if last is not None:
                    gaps.append(message.clock - last)
                last = message.clock
            seconds = time.monotonic() - start
            received = stream.received - messages_before
            mean_bytes = (stream.received_bytes - bytes_before) / received if received else 0.0
            stream.refresh()
            if show(Window(seconds, count, mean_bytes, tuple(gaps), stream.lost)):
                return
