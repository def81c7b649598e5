"""Finds and changes the `set` of a component in a DDSL file; all other characters stay.

In: a file, the full name of an instance, the path of a parameter. Out: the `set` statement, or the
new text of the file. An edit is verified: the new text has the same tree but for the new value.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from robocomp_dsl.deploy.write_text import FileNotReplaced, write_text
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.finding import Location, SourceText
from robocomp_dsl.runtime.parameters.overrides import parse_path
from robocomp_dsl.runtime.parameters.tree import Scalar, TextSyntax
from robocomp_dsl.runtime.parameters.value_list import split
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
    setting = _find_setting(_blocks_of(parse(source, Report()), instance), parameter)
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
        write_text(path, text)
    except FileNotReplaced as error:
        raise CannotEdit(str(error)) from None
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
    blocks = _blocks_of(file, instance)
    if not blocks:
        raise CannotEdit(f"{path.name} has no component `{instance}`")
    setting = _find_setting(blocks, parameter)
    if setting is not None:
        start, end = setting.value.span.start, setting.value.span.end
        new = text[:start] + literal + text[end:]
    else:
        innermost, key = blocks[-1]
        new = _insert(text, innermost, f"set {key}{parameter} = {literal};")
    _verify(new, path, instance, parameter, literal, len(blocks))
    return new


def format_ddsl_value(parameter: str, text: str, types: Mapping[str, str]) -> str:
    """A value of the command line as DDSL writes it.

    `types` are those of the parameters, as `float` and `float[1:8]`; `parameter` may be an element.
    """
    type_ = types.get(parameter) or types.get(parameter.rpartition("[")[0], "")
    kind, bracket, _ = type_.partition("[")
    if not bracket or parameter not in types:
        return format_ddsl_literal(text.strip(), is_text=kind == "string")
    whole = Scalar(Location(SourceText(parameter)), text, TextSyntax.RAW)
    elements = [format_ddsl_literal(e.text, is_text=kind == "string") for e in split(whole)]
    return f"{{{', '.join(elements)}}}"


def format_ddsl_literal(value: str, *, is_text: bool) -> str:
    """A value as a DDSL literal: a number, `true`, `false`, or a string."""
    if not is_text and (_NUMBER.fullmatch(value) or value in ("true", "false")):
        return value
    escaped = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{escaped}"'


def _insert(text: str, tree: ast.Instance | ast.Group, statement: str) -> str:
    """`text` with a new statement: after the last `set`, or first in the block."""
    newline = "\r\n" if "\r\n" in text else "\n"
    if tree.settings:
        last = tree.settings[-1].span
        indent = _indent_before(text, last.start)
        separator = " " if indent is None else f"{newline}{indent}"
        return f"{text[: last.end]}{separator}{statement}{text[last.end :]}"
    kind = tree.component if isinstance(tree, ast.Instance) else tree.definition
    heads = (tree.name, kind, tree.host, tree.label)
    head = max(filter(None, heads), key=lambda node: node.span.end)
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
    text: str, path: Path, instance: str, parameter: str, literal: str, blocks: int
) -> None:
    report = Report()
    found = _blocks_of(parse(Source(path, text), report), instance)
    setting = _find_setting(found, parameter)
    written = setting.value.span.text if setting else None
    if report.has_errors or written != literal or len(found) != blocks:
        raise CannotEdit(f"write `set {parameter} = {literal};` into {path.name} yourself")


_Block: TypeAlias = "tuple[ast.Instance | ast.Group, str]"
"""A block whose `set` applies to an instance, and what its keys begin with there: `motor.`."""


def _blocks_of(file: ast.File, full_name: str) -> list[_Block]:
    """The blocks in which a parameter of an instance may be set, the outermost first.

    The innermost is the instance, or the instance of a group whose definition contains it. Empty if
    there is no such instance.
    """
    names = full_name.rpartition("/")[2].split("-")  # without the prefix, names are unique, too
    scope: ast.Deployment | ast.Group | None = file.deployment
    blocks: list[_Block] = []
    for position, name in enumerate(names):
        rest = names[position + 1 :]
        instances = [tree for tree in scope.instances if tree.name.text == name] if scope else []
        if instances and not rest:
            return [*blocks, (instances[0], "")]
        scope = next((g for g in scope.groups if g.name.text == name), None) if scope else None
        if scope is None:
            return []
        blocks.append((scope, "".join(f"{each}." for each in rest)))
        if scope.definition is not None:
            return blocks if rest else []
    return []


def _find_setting(blocks: Sequence[_Block], parameter: str) -> ast.Setting | None:
    """The `set` of a parameter that is in force: the last one of the outermost block."""
    for tree, key in blocks:
        path = parse_path(f"{key}{parameter}")
        same = [setting for setting in tree.settings if parse_path(setting.key.text) == path]
        if same:
            return same[-1]
    return None
