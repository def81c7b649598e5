"""Finds the definitions of ROS 1 messages.

In: `package/msg/Name`. Out: its constants and fields, from ROS Noetic's messages in the library
rosbags, else from the generated code, or from a `.msg` file in the folders of ROS_PACKAGE_PATH and
AMENT_PREFIX_PATH.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from rosbags.typesys import Stores, get_typestore

_BUILT_IN = {
    "builtin_interfaces/msg/Time": "time",
    "builtin_interfaces/msg/Duration": "duration",
}
_FIELD = re.compile(r"(?P<type>[\w/]+(?:<=\d+)?(?:\[[^\]]*\])?)\s+(?P<name>\w+)\s*(?P<rest>.*)")


@dataclass(frozen=True, slots=True)
class Definition:
    """`constants` are type, name and value as written, `fields` type and name."""

    constants: tuple[tuple[str, str, str], ...]
    fields: tuple[tuple[str, str], ...]

    @property
    def text(self) -> str:
        """As in a `.msg` file."""
        lines = [f"{type_} {name}={value}" for type_, name, value in self.constants]
        return "\n".join([*lines, *(f"{type_} {name}" for type_, name in self.fields)])


def find_definition(type_id: str, text: str = "") -> Definition | None:
    """The definition of `package/msg/Name`; None if there is none.

    `text` is that of the generated code, for definitions with constants.
    """
    found = _of_noetic(type_id)
    if found is None and text:
        return parse_definition(text, type_id.partition("/")[0])
    return found or _of_file(type_id, os.environ)


@cache
def _noetic() -> Any:
    return get_typestore(Stores.ROS1_NOETIC)


@cache
def _of_noetic(type_id: str) -> Definition | None:
    store = _noetic()
    if type_id not in store.fielddefs:
        return None
    text, _ = store.generate_msgdef(type_id, ros_version=1)
    return parse_definition(text.partition("=" * 80)[0], type_id.partition("/")[0])


def _of_file(type_id: str, environment: Mapping[str, str]) -> Definition | None:
    package, kind, name = type_id.split("/")
    if kind != "msg":
        return None
    for root in _folders(environment):
        for path in (
            root / package / "msg" / f"{name}.msg",
            root / "share" / package / "msg" / f"{name}.msg",
            root / "msg" / f"{name}.msg" if root.name == package else None,
        ):
            if path is not None and path.is_file():
                text = path.read_text(encoding="utf-8", errors="replace")
                return parse_definition(text, package)
    return None


def _folders(environment: Mapping[str, str]) -> list[Path]:
    return [
        Path(folder)
        for variable in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH")
        for folder in environment.get(variable, "").split(os.pathsep)
        if folder
    ]


def parse_definition(text: str, package: str) -> Definition:
    """The definition in a `.msg` file, of ROS 1 or ROS 2, in the form of ROS 1."""
    constants, fields = [], []
    for line in text.splitlines():
        found = _FIELD.fullmatch(line.split("#")[0].strip())
        if found is None:
            continue
        type_, name = found["type"], found["name"]
        if found["rest"].startswith("="):
            whole = line if type_ == "string" else line.split("#")[0]
            constants.append((type_, name, whole.partition("=")[2].strip()))
        else:
            fields.append((_ros1_type(type_, package), name))
    return Definition(tuple(constants), tuple(fields))


def _ros1_type(type_: str, package: str) -> str:
    """`std_msgs/Header[]` for `Header[<=3]` and `std_msgs/msg/Header[<=3]`."""
    element, bracket, size = type_.partition("[")
    element = element.partition("<=")[0].replace("/msg/", "/")
    size = "]" if size.startswith("<=") else size
    if element == "Header":
        element = "std_msgs/Header"
    elif element[:1].isupper():
        element = f"{package}/{element}"
    parts = element.partition("/")
    element = _BUILT_IN.get(f"{parts[0]}/msg/{parts[2]}", element)
    return element + bracket + size
