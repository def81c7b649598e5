"""The messages of a ROS 1 action, which follow from its definition (`genaction`).

In: the name of a message such as `demo_msgs/msg/MoveActionGoal.msg`, and how to find definitions.
Out: the path of a virtual file beside `demo_msgs/action/Move.action`, where `genaction` writes it.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.check.workspace.source_cache import SourceCache
from robocomp_dsl.source import UnreadableSource

PARTS = ("Goal", "Result", "Feedback")
"""The sections of a definition, in order."""
_MESSAGE = re.compile(
    r"(?P<package>\w+)/msg/(?P<action>\w+?)(?P<wraps>Action)?(?P<part>Goal|Result|Feedback)\.msg"
)
_SEPARATOR = re.compile(r"^[ \t]*---[ \t]*(?:#.*)?$", re.MULTILINE)


def action_message(
    name: str, find: Callable[[str], Path | None], files: SourceCache
) -> Path | None:
    """The file of a message of an action; None if there is no such action."""
    found = _MESSAGE.fullmatch(name)
    if found is None:
        return None
    action = find(f"{found['package']}/action/{found['action']}.action")
    if action is None:
        return None
    path = action.parent.parent / "msg" / name.rpartition("/")[2]
    try:
        text = _text(files.read(action).text, found)
    except UnreadableSource:
        return None
    if not files.exists(path) or files.read(path).text != text:
        files.set_virtual(path, text)
    return path


def _text(definition: str, found: re.Match[str]) -> str:
    """The message: a section of the definition, or what wraps it."""
    part = found["part"]
    if not found["wraps"]:
        sections = _SEPARATOR.split(definition)
        index = PARTS.index(part)
        return sections[index] if index < len(sections) else ""
    status = (
        "actionlib_msgs/GoalID goal_id" if part == "Goal" else "actionlib_msgs/GoalStatus status"
    )
    own = f"{found['package']}/{found['action']}{part} {part.lower()}"
    return f"std_msgs/Header header\n{status}\n{own}\n"
