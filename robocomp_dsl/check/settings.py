"""`set key = value;` of a deployment against the parameters of the component.

In: the lines as written and the parameters. Out: keys and plain values, and findings.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from robocomp_dsl.check import codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.literals import Misfit, OutOfRange, listing
from robocomp_dsl.check.names import report_repeat
from robocomp_dsl.check.parameter_values import as_kind, check_range, plain
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.model import types
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Kind, Parameter
from robocomp_dsl.syntax.ast_base import Name, Text
from robocomp_dsl.syntax.ast_ddsl import Setting

_STEP = re.compile(r"(?P<name>\w+)(?P<index>(?:\[\s*\d+\s*\])*)")


class _Unknown(Exception):
    """A key leads nowhere; the message says why, `guess` is the key that may be meant."""

    def __init__(self, message: str, guess: str | None = None, way_out: str = "") -> None:
        super().__init__(message)
        self.guess = guess
        self.way_out = way_out


def settings_of(
    written: Sequence[Setting], component: Component, report: Report
) -> tuple[tuple[str, types.Literal], ...]:
    """The settings that are right, in order of writing."""
    first: dict[str, Name] = {}
    made = []
    for one in written:
        earlier = first.setdefault(one.key.text, one.key)
        if earlier is not one.key:
            report_repeat(one.key, earlier, "setting", report)
            continue
        value = _value(one, component, report)
        if value is not None:
            made.append((one.key.text, value))
    return tuple(made)


def _value(one: Setting, component: Component, report: Report) -> types.Literal | None:
    try:
        parameter = _find(one.key.text, component)
    except _Unknown as unknown:
        report.add(
            codes.UNKNOWN_SETTING,
            one.key.span,
            str(unknown),
            label=f"did you mean `{unknown.guess}`?" if unknown.guess else "",
            fix=replace(one.key.span, unknown.guess) if unknown.guess else None,
            help=unknown.way_out,
        )
        return None
    try:
        value = _fit(one, parameter)
        check_range(value, parameter)
    except Misfit as wrong:
        code = codes.SETTING_RANGE if isinstance(wrong, OutOfRange) else codes.SETTING_TYPE
        report.add(
            code,
            one.value.span,
            f"`{one.key.text}` cannot be set to this: {wrong}",
            label=wrong.label,
            notes=[Note(parameter.span, f"`{parameter.name}` is declared here")],
        )
        return None
    return value


def _fit(one: Setting, parameter: Parameter) -> types.Literal:
    """As for a default; a bare word will do for a text."""
    written = one.value
    if parameter.kind is Kind.STRING and isinstance(written, Name):
        written = Text(written.span, written.text)
    return as_kind(written, parameter.kind, parameter.choices)


def _find(key: str, component: Component) -> Parameter:
    """The parameter that a dotted key means."""
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
        found = next((one for one in members if one.name == name), None)
        if found is None:
            raise _unknown_name(key, place, name, component, members)
        place = f"{place}.{name}{index}" if place else f"{name}{index}"
        _check_index(place, index, found)
        members = found.members
    if found is None:  # a key has a step at least
        raise _Unknown(f"`{key}` is no name")
    if found.kind is Kind.GROUP:
        inside = listing([one.name for one in found.members])
        raise _Unknown(f"`{place}` is a group: set one of its members, {inside}")
    return found


def _check_index(place: str, index: str, found: Parameter) -> None:
    if found.kind is not Kind.GROUP or found.single:
        if index:
            raise _Unknown(f"`{place}`: `{found.name}` is not a list", place.removesuffix(index))
        return
    numbers = re.findall(r"\d+", index)
    if len(numbers) != 1:
        raise _Unknown(f"`{place}` is a list of groups: say which one, as `{found.name}[0]`")
    if found.high is not None and int(numbers[0]) >= found.high:
        most = plain(found.high)
        raise _Unknown(f"`{place}` is beyond the end: `{found.name}` has at most {most}")


def _unknown_name(
    key: str, place: str, name: str, component: Component, members: Sequence[Parameter]
) -> _Unknown:
    where = f"`{place}`" if place else f"`{component.name}`"
    near = nearest(name, [one.name for one in members])
    if near is None:
        known = listing([one.name for one in members])
        return _Unknown(f"{where} has no parameter `{name}`, only {known}")
    steps = key.split(".")
    at = place.count(".") + 1 if place else 0
    steps[at] = steps[at].replace(name, near, 1)
    return _Unknown(f"{where} has no parameter `{name}`", ".".join(steps))
