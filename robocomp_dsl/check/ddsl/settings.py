"""Checks `set key = value;` of a deployment against the parameters of the component.

In: the settings and the parameters. Out: keys and values, and diagnostics. A path is relative to
the file in which it is written.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.ddsl.setting_paths import PathSearch
from robocomp_dsl.check.ddsl.setting_values import value_of
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.duplicates import report_duplicate
from robocomp_dsl.check.pdsl.values import format_number
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Report, nearest
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Default, Kind, Parameter
from robocomp_dsl.syntax.ast.base import LiteralList, Name
from robocomp_dsl.syntax.ast.ddsl import Setting

_STEP = re.compile(r"(?P<name>\w+)(?P<index>(?:\[\s*\d+\s*\])*)")


class _Unknown(Exception):
    """A key names no parameter; the message says why, `guess` is a suggestion."""

    def __init__(self, message: str, guess: str | None = None, way_out: str = "") -> None:
        super().__init__(message)
        self.guess = guess
        self.way_out = way_out


def settings_of(
    written: Sequence[Setting], component: Component, search: PathSearch, report: Report
) -> tuple[tuple[tuple[str, Default], ...], tuple[Path, ...]]:
    """The valid settings in order of writing, and the files and folders that they name.

    Those of elements of lists are last, because a list replaces its elements. `search` finds the
    paths.
    """
    first: dict[str, Name] = {}
    settings: list[tuple[str, Default]] = []
    paths: list[Path] = []
    for setting in written:
        earlier = first.setdefault(setting.key.text, setting.key)
        if earlier is not setting.key:
            report_duplicate(setting.key, earlier, "setting", report)
            continue
        parameter = _parameter(setting, component, report)
        value = value_of(setting, parameter, report) if parameter else None
        if value is None or parameter is None:
            continue
        if parameter.is_path:
            value = _found(setting, value, search, paths, report)
        settings.append((setting.key.text, value))
    settings.sort(key=lambda item: item[0].endswith("]"))
    return tuple(settings), tuple(dict.fromkeys(paths))


def _found(
    setting: Setting, value: Default, search: PathSearch, paths: list[Path], report: Report
) -> Default:
    """The absolute paths of a value; adds to `paths`."""
    values = value if isinstance(value, tuple) else (value,)
    written = setting.value
    nodes = written.items if isinstance(written, LiteralList) else (written,)
    found = []
    for text, node in zip(map(str, values), nodes, strict=True):
        path = search.find(text, setting, node, report) if text else None
        paths += [path] if path else []
        found.append(str(path or text))
    return tuple(found) if isinstance(value, tuple) else found[0]


def _parameter(setting: Setting, component: Component, report: Report) -> Parameter | None:
    try:
        return _find(setting.key.text, component)
    except _Unknown as unknown:
        report.add(
            codes.UNKNOWN_SETTING,
            setting.key.span,
            str(unknown),
            label=f"did you mean `{unknown.guess}`?" if unknown.guess else "",
            fix=replace_fix(setting.key.span, unknown.guess) if unknown.guess else None,
            help=unknown.way_out,
        )
        return None


def _find(key: str, component: Component) -> Parameter:
    """The parameter at a dotted key."""
    if component.parameters is None:
        name = component.path.name
        way_out = f'`{name}` names none: `parameters "{component.path.stem}.pdsl";` adds them'
        raise _Unknown(f"`{component.name}` has no parameters", way_out=way_out)
    members, place = component.parameters.parameters, ""
    found: Parameter | None = None
    for step in key.split("."):
        match = _STEP.fullmatch(step)
        name, index = (match["name"], match["index"]) if match else (step, "")
        if found is not None and found.kind is not Kind.GROUP:
            raise _Unknown(f"`{place}` is no group, so it has no `{name}`")
        found = next((setting for setting in members if setting.name == name), None)
        if found is None:
            raise _unknown_name(key, place, name, component, members)
        place = f"{place}.{name}{index}" if place else f"{name}{index}"
        found = _indexed(place, index, found)
        members = found.members
    if found is None:  # a key has a step at least
        raise _Unknown(f"`{key}` is not the name of a parameter")
    if found.kind is Kind.GROUP:
        inside = join_names([setting.name for setting in found.members])
        raise _Unknown(f"`{place}` is a group: set one of its members, {inside}")
    return found


def _indexed(place: str, index: str, found: Parameter) -> Parameter:
    """The parameter at an index: a group of a list, or one element of a list of values."""
    if found.is_list:
        return _element(place, index, found) if index else found
    if found.kind is not Kind.GROUP or found.single:
        if index:
            raise _Unknown(f"`{place}`: `{found.name}` is not a list", place.removesuffix(index))
        return found
    numbers = re.findall(r"\d+", index)
    if len(numbers) != 1:
        raise _Unknown(f"`{place}` is a list of groups: add an index, as in `{found.name}[0]`")
    if found.high is not None and int(numbers[0]) >= found.high:
        most = format_number(found.high)
        raise _Unknown(f"`{place}` is beyond the end: `{found.name}` has at most {most}")
    return found


def _element(place: str, index: str, found: Parameter) -> Parameter:
    numbers = re.findall(r"\d+", index)
    if len(numbers) != 1:
        way_out = place.removesuffix(index)
        raise _Unknown(f"`{place}`: the elements of `{found.name}` are not lists", way_out)
    if found.longest is not None and int(numbers[0]) >= found.longest:
        length = found.describe_length()
        raise _Unknown(f"`{place}` is beyond the end: `{found.name}` has {length}, [0] is first")
    return found.replace(shortest=None, longest=None, default=None)


def _unknown_name(
    key: str, place: str, name: str, component: Component, members: Sequence[Parameter]
) -> _Unknown:
    where = f"`{place}`" if place else f"`{component.name}`"
    near = nearest(name, [setting.name for setting in members])
    if near is None:
        known = join_names([setting.name for setting in members])
        return _Unknown(f"{where} has no parameter `{name}`, only {known}")
    steps = key.split(".")
    at = place.count(".") + 1 if place else 0
    steps[at] = steps[at].replace(name, near, 1)
    return _Unknown(f"{where} has no parameter `{name}`", ".".join(steps))
