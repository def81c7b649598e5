"""Reads descriptions of yarprobotinterface, with the files that they include.

In: a file. Out: its devices with parameters and actions as data, and findings. Formats 1.0 and 3.0
are read: `file="…"` and `xi:include`; a path is relative to its file, else to the first file.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeAlias

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.yarp import codes
from robocomp_dsl.migrate.yarp.document import attribute, children, name_of, read_document, text_of
from robocomp_dsl.source import Source, Span, UnreadableSource
from robocomp_dsl.syntax.ast.innermodel import Element

MAX_FILES = 2000
PHASES = ("startup", "run", "interrupt1", "interrupt2", "interrupt3", "shutdown")
_MACRO = re.compile(r"\$\{(\w+)\}")

Values: TypeAlias = "dict[str, str | Values]"
"""Parameters by name; a group has parameters of its own."""


@dataclass(frozen=True, slots=True)
class RobotAction:
    """An action of a device in a phase; `verb` is the type of YARP, in lower case."""

    phase: str
    level: int
    verb: str
    values: Values
    span: Span


@dataclass(slots=True)
class RobotDevice:
    """One device."""

    name: str
    kind: str
    span: Span
    values: Values = field(default_factory=dict)
    actions: list[RobotAction] = field(default_factory=list)


@dataclass(slots=True)
class YarpRobot:
    """A robot. `reverses`: in interrupts and shutdown, levels run in decreasing order.

    `tags` enable parts with one of them in `enabled_by`; `all` enables all parts.
    """

    name: str
    prefix: str
    span: Span
    reverses: bool = False
    tags: frozenset[str] = frozenset()
    devices: list[RobotDevice] = field(default_factory=list)
    files: list[Path] = field(default_factory=list)


def read_robot(
    source: Source, report: Report, tags: frozenset[str] = frozenset()
) -> YarpRobot | None:
    """The robot of a file, with the parts that `tags` enable; None if it has no root element."""
    root = read_document(source, report)
    if root is None:
        return None
    name = attribute(root, "name") if name_of(root) == "robot" else ""
    stem = source.path.name.partition(".")[0]
    prefix = attribute(root, "portprefix") or name or stem
    robot = YarpRobot(name or stem, f"/{prefix.strip('/')}", root.tag.span)
    robot.tags = tags
    robot.reverses = attribute(root, "reverse-shutdown-action-order").lower() in ("true", "1")
    robot.files.append(source.path)
    reader = _Reader(robot, source.path.parent, report)
    reader.add([root] if name_of(root) == "device" else root.children, source)
    return robot


class _Reader:
    """Adds the devices of files to a robot."""

    def __init__(self, robot: YarpRobot, folder: Path, report: Report) -> None:
        self._robot = robot
        self._folder = folder
        self._report = report
        self._open: list[Path] = []

    def add(self, elements: tuple[Element, ...] | list[Element], source: Source) -> None:
        """Add the devices among `elements`; parameters of the robot itself are not used."""
        for element, origin in self._expanded(elements, source):
            match name_of(element):
                case "devices" | "robot":
                    self.add(element.children, origin)
                case "device":
                    self._add_device(element, origin)
                case "param" | "params" | "group" | "paramlist" | "actions" | "action":
                    pass
                case _:
                    self._unknown(element)

    def _expanded(
        self, elements: tuple[Element, ...] | list[Element], source: Source
    ) -> Iterator[tuple[Element, Source]]:
        """The elements, with those of included files instead of the inclusions."""
        for element in elements:
            is_include = name_of(element) == "include"
            path = attribute(element, "href" if is_include else "file")
            if is_include and not self._is_enabled(element, path):
                continue
            if not path:
                if is_include:
                    self._report.add(codes.INCLUDE, element.tag.span, "an inclusion without `href`")
                else:
                    yield element, source
                continue
            yield from self._included(path, element, source)

    def _is_enabled(self, element: Element, path: str) -> bool:
        enabled, disabled = (attribute(element, f"{key}_by") for key in ("enabled", "disabled"))
        if not enabled or self._robot.tags & {"all", *enabled.split()}:
            if disabled:
                message = f"`{path:.100}` is included; `--disable_tags ({disabled:.60})` omitted it"
                self._report.add(codes.SETTING_NOT_NEEDED, element.tag.span, message)
            return True
        self._report.add(
            codes.SETTING_DROPPED,
            element.tag.span,
            f"`{path:.100}` is left out, because it is enabled by `{enabled:.60}`",
            help=f"include it: `rcgen migrate --enable {enabled.split()[0]:.60} …`",
        )
        return False

    def _included(
        self, written: str, element: Element, source: Source
    ) -> Iterator[tuple[Element, Source]]:
        span = element.tag.span
        candidates = [source.path.parent / written, self._folder / written]
        path = next((each for each in candidates if each.is_file()), candidates[0])
        resolved = path.resolve()
        if resolved in self._open or len(self._robot.files) >= MAX_FILES:
            message = f"`{written:.200}` includes itself, or there are too many files"
            self._report.add(codes.INCLUDE, span, message)
            return
        try:
            included = Source.read(path)
        except UnreadableSource as error:
            self._report.add(codes.INCLUDE, span, f"`{written:.200}`: {error}")
            return
        self._robot.files.append(path)
        root = read_document(included, self._report)
        if root is None:
            return
        self._open.append(resolved)
        inner = root.children if name_of(root) in ("devices", "params", "actions") else (root,)
        yield from self._expanded(inner, included)
        self._open.pop()

    def _add_device(self, element: Element, source: Source) -> None:
        name, kind = attribute(element, "name"), attribute(element, "type")
        span = element.tag.span
        if not name or not kind:
            message = "a device needs `name` and `type`"
            self._report.add(codes.INCOMPLETE_ELEMENT, span, message)
            return
        if any(device.name == name for device in self._robot.devices):
            message = f"there are two devices `{name:.60}`; the first one is used"
            self._report.add(codes.INCOMPLETE_ELEMENT, span, message)
            return
        device = RobotDevice(name, kind, span)
        device.values = self._values(element.children, source)
        device.actions = list(self._actions(element.children, source))
        self._robot.devices.append(device)

    def _values(self, elements: tuple[Element, ...], source: Source) -> Values:
        values: Values = {}
        for element, origin in self._expanded(elements, source):
            name = attribute(element, "name").strip()
            match name_of(element):
                case "params":
                    _merge(values, self._values(element.children, origin))
                case "group" if name:
                    group: Values = {name: self._values(element.children, origin)}
                    _merge(values, group)
                case "paramlist" if name:
                    items = list(children(element, "elem"))
                    names = " ".join(attribute(each, "name") for each in items)
                    entries: Values = {attribute(each, "name"): self._text(each) for each in items}
                    _merge(values, {name: names} | entries)
                case "param" if name:
                    _merge(values, {name: self._param(element)})
                case "action" | "actions":
                    pass
                case "param" | "paramlist" | "group":
                    message = f"`<{element.tag.text}>` without a name"
                    self._report.add(codes.INCOMPLETE_ELEMENT, element.tag.span, message)
                case _:
                    self._unknown(element)
        return values

    def _param(self, element: Element) -> str:
        value, option = self._text(element), attribute(element, "extern-name")
        if option:
            message = f"`--{option:.60}` of the command line; `{value:.60}` is used"
            self._report.add(codes.SETTING_DROPPED, element.tag.span, message)
        return value

    def _text(self, element: Element) -> str:
        """The text of an element with its macros replaced."""
        macros = {
            "portprefix": self._robot.prefix,
            "portprefixnoslash": self._robot.prefix.strip("/"),
            "robotname": self._robot.name,
        }
        return _MACRO.sub(lambda match: macros.get(match[1], match[0]), text_of(element))

    def _actions(self, elements: tuple[Element, ...], source: Source) -> Iterator[RobotAction]:
        for element, origin in self._expanded(elements, source):
            if name_of(element) == "actions":
                yield from self._actions(element.children, origin)
            elif name_of(element) == "action" and (action := self._action(element, origin)):
                yield action

    def _action(self, element: Element, source: Source) -> RobotAction | None:
        phase, level, verb = (attribute(element, key) for key in ("phase", "level", "type"))
        phase = phase.lower()
        if phase in PHASES and re.fullmatch(r"\d{1,9}", level, re.ASCII) and verb:
            values = self._values(element.children, source)
            return RobotAction(phase, int(level), verb.lower(), values, element.tag.span)
        message = f"an action needs a `level`, a `type`, and a `phase`: {', '.join(PHASES)}"
        self._report.add(codes.INCOMPLETE_ELEMENT, element.tag.span, message)
        return None

    def _unknown(self, element: Element) -> None:
        message = f"`<{element.tag.text:.60}>` is unknown here, and was ignored"
        self._report.add(codes.UNKNOWN_ELEMENT, element.tag.span, message)


def _merge(values: Values, others: Values) -> None:
    """Add `others`; groups of the same name are joined, and of other values the first stays."""
    for name, value in others.items():
        present = values.setdefault(name, value)
        if present is not value and isinstance(present, dict) and isinstance(value, dict):
            _merge(present, value)
