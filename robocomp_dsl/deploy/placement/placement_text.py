"""Formats choices of hosts as text, with their numbers. Pure."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robocomp_dsl.deploy.placement.placement_choice import CandidateScore, PlacementChoice

_HEAD = ("host", "components", "load 1 min", "5 min", "15 min", "cpus", "score", "")


def placement_lines(choices: Sequence[PlacementChoice]) -> Iterator[str]:
    """A table for each choice: its candidates with load, score and the chosen one."""
    for choice in choices:
        yield f"{', '.join(choice.instances)} on {choice.host}: {choice.reason}"
        by_load = any(score.load for score in choice.candidates)
        rows = [_HEAD, *(_row(score) for score in choice.candidates)]
        columns = range(len(_HEAD)) if by_load else (0, 1, len(_HEAD) - 1)
        widths = {column: max(len(row[column]) for row in rows) for column in columns}
        for row in rows:
            cells = [
                row[column].ljust(width)
                if column in (0, len(_HEAD) - 1)
                else row[column].rjust(width)
                for column, width in widths.items()
            ]
            yield ("   " + "  ".join(cells)).rstrip()


def _row(score: CandidateScore) -> tuple[str, ...]:
    load = score.load
    numbers = (
        (f"{load.load1:.2f}", f"{load.load5:.2f}", f"{load.load15:.2f}", str(load.cpus))
        if load
        else ("?",) * 4
    )
    value = "?" if score.score is None else f"{score.score:.3f}"
    chosen = "chosen" if score.chosen else ""
    return (score.host, str(score.components), *numbers, value, chosen)
