"""`rcdeploy bw`: how many bytes a port publishes. In: a port. Out: a line per second."""

from __future__ import annotations

from robocomp_dsl.cli.rcdeploy.inspect.rate import Window, measuring_command


def _line(figures: dict[str, float]) -> str:
    return (
        f"{_bytes(figures['bytes_per_s'])}/s  {figures['messages_per_s']:.1f} messages/s"
        f"  mean {_bytes(figures['mean_bytes'])}  lost {figures['lost']}"
    )


def _bytes(count: float) -> str:
    for unit in ("B", "kB", "MB"):
        if count < 1000:
            return f"{count:.4g} {unit}"
        count /= 1000
    return f"{count:.4g} GB"


command = measuring_command(
    Window.bandwidth, _line, "Print how many bytes a port publishes, every second, until Ctrl-C."
)
