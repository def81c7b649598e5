"""`rcdeploy hz`: how often a port publishes. In: a port. Out: a line per second."""

from __future__ import annotations

from robocomp_dsl.cli.rcdeploy.inspect.rate import Window, measuring_command


def _line(figures: dict[str, float]) -> str:
    if not figures["messages"]:
        return "no messages"
    return (
        "{hz:.2f} Hz  min {min_ms:.2f} ms  max {max_ms:.2f} ms  std {std_ms:.2f} ms"
        "  lost {lost}".format(**figures)
    )


command = measuring_command(
    Window.rate, _line, "Print how often a port publishes, every second, until Ctrl-C."
)
