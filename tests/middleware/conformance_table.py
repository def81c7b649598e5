"""Writes docs/reference/middlewares.md: capabilities of all middlewares, and what their tests show.

`python -m tests.middleware.conformance_table build/conformance.json`; `make conformance` runs the
suite before. In: descriptions, and the report of a run. Out: the page.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, TypeAlias

from robocomp_dsl.runtime.middleware.capabilities import QOS_ITEMS, MiddlewareDescription
from robocomp_dsl.runtime.middleware.registry import BUILT_IN, description_of

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "middlewares.md"
Results: TypeAlias = dict[str, dict[str, dict[str, Any]]]
YES, NO = "yes", "-"
CAPABILITIES = {
    "between_processes": "connects processes",
    "between_hosts": "connects machines",
    "services": "services (`implements`, `requires`)",
    "topics": "topics (`publishes`, `subscribesTo`)",
    "external_peers": "programs that are no components (`extern`)",
    "fixed_address": "address of an own port (`at`)",
    "ros_types_only": "only types that are imported from ROS",
    "external_ros_types": "programs that are no components: only types that are imported from ROS",
    "topic_versions": "topics between two versions of an interface: what is the same arrives",
    "sequence_numbers": "numbers of publications: losses in the network are counted",
}
_HEAD = """\
# Middlewares

What each middleware can do, and how many cases of the conformance suite it passes. This page is
generated: `make conformance` runs the suite over all installed middlewares and writes it.
[What the planes are, and how to write a middleware](../explanation/middlewares.md).

"""


def described() -> list[MiddlewareDescription]:
    """The built-in middlewares, sorted by name."""
    found = (description_of(name) for name in sorted(BUILT_IN))
    return [description for description in found if description]


def page(results: Results) -> str:
    """The whole page."""
    return f"{_HEAD}{summaries()}\n{capabilities()}\n{conformance(results)}"


def summaries() -> str:
    """A line for each middleware."""
    lines = [f"- `{each.name}`: {each.summary}." for each in described()]
    return "\n".join(lines) + "\n"


def capabilities() -> str:
    """The table of capabilities, from the descriptions."""
    middlewares = described()
    rows = [
        [text, *(_mark(getattr(each.capabilities, field)) for each in middlewares)]
        for field, text in CAPABILITIES.items()
    ]
    for item in QOS_ITEMS:
        supported = (_mark(item in each.capabilities.qos) for each in middlewares)
        rows.append([f"quality of service `{item}`", *supported])
    sizes = (_size(each.capabilities.max_message_bytes) for each in middlewares)
    rows.append(["longest message", *sizes])
    table = _table(["", *(each.name for each in middlewares)], rows)
    text = (
        "`depth`, `deadline`, `liveliness` and `thread_priority` belong to the receiver and are"
        " available with all of them."
    )
    return f"## Capabilities\n\n{table}\n{_wrap(text)}"


def conformance(results: Results) -> str:
    """The table of the run, and why cases do not apply."""
    names = sorted(results)
    features = sorted({feature for per_feature in results.values() for feature in per_feature})
    rows = [
        [feature, *(_cell(results[name].get(feature)) for name in names)] for feature in features
    ]
    text = "Passed cases; a dash: the capabilities exclude all cases of the row."
    absent = [each for each in described() if each.name not in results]
    ros = [f"`{each.name}`" for each in absent if each.capabilities.ros_types_only]
    missing = [each.name for each in absent if not each.capabilities.ros_types_only]
    if ros:
        text += f" {', '.join(ros)}: [tests of their own](../how-to/ros2.md), with types of ROS."
    if missing:
        text += f" Not installed in this run: {', '.join(missing)}."
    return f"## Conformance\n\n{_wrap(text)}\n{_table(['', *names], rows)}{_reasons(results)}"


def _reasons(results: Results) -> str:
    """Why cases were skipped, for each middleware."""
    lines = []
    for name, features in sorted(results.items()):
        reasons = sorted({why for result in features.values() for why in result["skipped"]})
        if reasons:
            lines.append(_wrap(f"- `{name}` skips cases: {'; '.join(reasons)}.", "  "))
    return "".join(["\n", *lines]) if lines else ""


def _cell(result: dict[str, Any] | None) -> str:
    if not result or not result["passed"] + result["failed"]:
        return NO
    count = result["passed"] + result["failed"]
    return f"**{result['passed']} of {count}**" if result["failed"] else str(count)


def _mark(supported: bool) -> str:
    return YES if supported else NO


def _size(limit: int) -> str:
    return f"{limit / 2**20:g} MiB" if limit else "no limit"


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _wrap(text: str, indent: str = "") -> str:
    """`text` in lines of at most 118 characters."""
    lines, line = [], ""
    for word in text.split(" "):
        if line and len(line) + 1 + len(word) > 118:
            lines.append(line)
            line = indent + word
        else:
            line = f"{line} {word}" if line else word
    return "\n".join([*lines, line]) + "\n"


def main(report: str) -> None:
    """Write the page from the report of a run."""
    PAGE.write_text(page(json.loads(Path(report).read_text())))


if __name__ == "__main__":
    main(*sys.argv[1:])
