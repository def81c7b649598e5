"""Finds and changes the `set` of a component in a DDSL file; all other characters stay.

In: a file, the full name of an instance, the path of a parameter. Out: the `set` statement, or the
new text of the file. An edit is verified: the new text has the same tree but for the new value.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.runtime.parameters.overrides import parse_path
from robocomp_dsl.source import Source, UnreadableSource
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.languages.ddsl import parse

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_INDENT = "    "


class CannotEdit(Exception):
    """The file cannot be changed; the message says why."""


@dataclass(frozen=True, slots=True)
class WrittenSetting:
    """A `set` statement: its place, as `app.ddsl:7`, and the value as it is written."""

    place: str
    value: str


def find_setting(path: Path, instance: str, parameter: str) -> WrittenSetting | None:
    """The `set` of a parameter in a DDSL file; None if there is none, or no readable file."""
    try:
        source = Source.read(path)
    except UnreadableSource:
        return None
    tree = _find_instance(parse(source, Report()), instance)
    setting = _find_setting(tree, parameter) if tree else None
    if setting is None:
        return None
    place = f"{path.name}:{setting.span.start_position[0]}"
    return WrittenSetting(place, setting.value.span.text)


def write_settings(path: Path, instance: str, values: dict[str, str]) -> None:
    """Write `set` statements of an instance, literals as of DDSL. Raises `CannotEdit`."""
    path = path.resolve()  # a link stays a link
    try:
        text = path.read_bytes().decode("utf-8")
        for parameter, literal in values.items():
            text = edit_text(text, path, instance, parameter, literal)
        new = path.with_name(f".{path.name}.new")
        new.write_bytes(text.encode("utf-8"))
        new.chmod(path.stat().st_mode & 0o777)
        new.replace(path)
    except UnicodeDecodeError:
        raise CannotEdit(f"{path} is not encoded in UTF-8") from None
    except OSError as error:
        raise CannotEdit(f"{path} cannot be written: {error.strerror}") from None


def edit_text(text: str, path: Path, instance: str, parameter: str, literal: str) -> str:
    """`text` with `set PARAMETER = LITERAL;` in an instance. Raises `CannotEdit`."""
    report = Report()
    file = parse(Source(path, text), report)
    if report.has_errors:
        raise CannotEdit(f"{path.name} has errors; see `rcdeploy check {path.name}`")
    tree = _find_instance(file, instance)
    if tree is None:
        raise CannotEdit(f"{path.name} has no component `{instance}`")
    setting = _find_setting(tree, parameter)
    if setting is not None:
        start, end = setting.value.span.start, setting.value.span.end
        new = text[:start] + literal + text[end:]
    else:
        new = _insert(text, tree, f"set {parameter} = {literal};")
    _verify(new, path, instance, parameter, literal, len(list(_instances(file))))
    return new


def format_ddsl_literal(value: str, *, is_text: bool) -> str:
    """A value as a DDSL literal: a number, `true`, `false`, or a string."""
    if not is_text and (_NUMBER.fullmatch(value) or value in ("true", "false")):
        return value
    escaped = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{escaped}"'


def _insert(text: str, tree: ast.Instance, statement: str) -> str:
    """`text` with a new statement: after the last `set`, or first in the block."""
    newline = "\r\n" if "\r\n" in text else "\n"
    if tree.settings:
        last = tree.settings[-1].span
        indent = _indent_before(text, last.start)
        separator = " " if indent is None else f"{newline}{indent}"
        return f"{text[: last.end]}{separator}{statement}{text[last.end :]}"
    head = tree.host or tree.component or tree.name
    rest = text[head.span.end : tree.span.end]
    if brace := re.match(r"\s*\{", rest):
        position = head.span.end + brace.end()
        indent = _indent_before(text, tree.span.start)
        if indent is None or "\n" not in rest:
            return f"{text[:position]} {statement}{text[position:]}"
        return f"{text[:position]}{newline}{indent}{_INDENT}{statement}{text[position:]}"
    return f"{text[: head.span.end]} {{ {statement} }}{text[head.span.end :]}"


def _indent_before(text: str, position: int) -> str | None:
    """The white space before `position`; None if something else is before it in its line."""
    line = text[text.rfind("\n", 0, position) + 1 : position]
    return None if line.strip() else line


def _verify(
    text: str, path: Path, instance: str, parameter: str, literal: str, instances: int
) -> None:
    report = Report()
    file = parse(Source(path, text), report)
    tree = _find_instance(file, instance)
    setting = _find_setting(tree, parameter) if tree else None
    found = setting.value.span.text if setting else None
    if report.has_errors or found != literal or len(list(_instances(file))) != instances:
        raise CannotEdit(f"write `set {parameter} = {literal};` into {path.name} yourself")


def _find_instance(file: ast.File, full_name: str) -> ast.Instance | None:
    return next((tree for name, tree in _instances(file) if name == full_name), None)


def _instances(file: ast.File) -> Iterator[tuple[str, ast.Instance]]:
    """All instances with their full names: prefix, groups and name."""
    if file.deployment is not None:
        yield from _members(file.deployment, "")


def _members(scope: ast.Deployment | ast.Group, group: str) -> Iterator[tuple[str, ast.Instance]]:
    for tree in scope.instances:
        prefix = getattr(tree.prefix, "value", None) or getattr(tree.prefix, "text", "")
        name = f"{group}{tree.name.text}"
        yield (f"{prefix}/{name}" if prefix else name), tree
    for inner in scope.groups:
        yield from _members(inner, f"{group}{inner.name.text}-")


def _find_setting(tree: ast.Instance, parameter: str) -> ast.Setting | None:
    """The last `set` of a parameter, which is the one in force."""
    path = parse_path(parameter)
    same = (s for s in tree.settings if parse_path(s.key.text) == path)
    return next(reversed(list(same)), None)
