"""Checks the class of a monitor against the interface of its connection, without running it.

In: the text of a Python file, the name of the class, the operations, the parameters of the
deployment. Out: findings with their place in the file, and the events that the class sets.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches

from robocomp_dsl.monitors.constraint import EVENT_NAME
from robocomp_dsl.monitors.hook_check import HookCheck, function_parameters
from robocomp_dsl.monitors.monitor_finding import MonitoredOperation, MonitorFinding

_VALUE_TYPES: Mapping[str, tuple[type, ...]] = {
    "bool": (bool,),
    "int": (int,),
    "float": (int, float),
    "str": (str,),
}


@dataclass(slots=True)
class MonitorClass:
    """What is known of the class of a monitor.

    `events` are the events that it sets; not `all_events_known`: it computes names of events, or
    inherits from a class of another file.
    """

    findings: list[MonitorFinding] = field(default_factory=list)
    events: set[str] = field(default_factory=set)
    all_events_known: bool = True


def check_monitor_class(
    text: str,
    name: str,
    operations: Sequence[MonitoredOperation],
    parameters: Mapping[str, object],
) -> MonitorClass:
    """Check the class `name` of the Python file `text`. Never raises."""
    try:
        return _check(text, ast.parse(text), name, operations, parameters)
    except SyntaxError as error:
        line, column = error.lineno or 1, max(error.offset or 1, 1)
        message = f"invalid Python: {error.msg}"
        finding = MonitorFinding(line, column, line, column + 1, message)
    except (ValueError, RecursionError, MemoryError) as error:
        finding = MonitorFinding(1, 1, 1, 2, f"invalid Python: {error}")
    return MonitorClass([finding], all_events_known=False)


def _check(
    text: str,
    tree: ast.Module,
    name: str,
    operations: Sequence[MonitoredOperation],
    parameters: Mapping[str, object],
) -> MonitorClass:
    result = MonitorClass()
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    cls = classes.get(name)
    if cls is None:
        result.findings.append(_missing_class(name, list(classes)))
        return result
    lineage = _Lineage(cls, classes)
    lines = text.splitlines()
    check = HookCheck(lines, operations)
    if not lineage.is_monitor and not lineage.has_unknown_base:
        check.report(
            cls,
            f"class `{name}` does not extend `Monitor`",
            "from robocomp_dsl.runtime import Monitor",
        )
    for method in lineage.methods.values():
        check.check_method(method)
    result.findings = check.findings
    result.findings += _check_parameters(cls, lineage, lines, parameters)
    _collect_events(lineage, check, result)
    return result


def _missing_class(name: str, classes: list[str]) -> MonitorFinding:
    near = get_close_matches(name, classes, 1)
    if near:
        help_text = f"did you mean `{near[0]}`?"
    else:
        help_text = f"its classes: {', '.join(classes)}" if classes else "it has no classes"
    return MonitorFinding(1, 1, 1, 1, f"the file has no class `{name}`", help_text)


class _Lineage:
    """A class and those of its base classes that are in the same file."""

    def __init__(self, cls: ast.ClassDef, classes: Mapping[str, ast.ClassDef]) -> None:
        self.classes: list[ast.ClassDef] = []
        self.is_monitor = False
        self.has_unknown_base = False
        self._add(cls, classes)
        self.methods: dict[str, ast.FunctionDef | ast.AsyncFunctionDef] = {}
        for node in self.classes:
            for item in node.body:
                if isinstance(item, ast.FunctionDef | ast.AsyncFunctionDef):
                    self.methods.setdefault(item.name, item)

    def _add(self, cls: ast.ClassDef, classes: Mapping[str, ast.ClassDef]) -> None:
        if cls in self.classes:
            return
        self.classes.append(cls)
        for base in cls.bases:
            name = _last_name(base)
            if name in classes and isinstance(base, ast.Name):
                self._add(classes[name], classes)
            elif name == "Monitor":
                self.is_monitor = True
            elif name != "object":
                self.has_unknown_base = True

    def fields(self) -> Iterator[tuple[str, str, bool]]:
        """Name, type and whether it is required, of the fields of dataclasses."""
        for cls in reversed(self.classes):
            if not any(_last_name(d) == "dataclass" for d in cls.decorator_list):
                continue
            for item in cls.body:
                if isinstance(item, ast.AnnAssign) and isinstance(item.target, ast.Name):
                    annotation = _last_name(item.annotation)
                    if annotation != "ClassVar":
                        yield item.target.id, annotation, item.value is None


def _last_name(node: ast.expr) -> str:
    """`c` of `a.b.c`, `a.b.c(…)` and `a.b.c[…]`; "" for any other expression."""
    match node:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
        case ast.Call(func=inner) | ast.Subscript(value=inner):
            return _last_name(inner)
        case ast.Constant(value=str(name)):
            return name
    return ""


def _check_parameters(
    cls: ast.ClassDef, lineage: _Lineage, lines: list[str], values: Mapping[str, object]
) -> Iterator[MonitorFinding]:
    """Compare the parameters of the deployment with the keywords of the constructor."""
    init = lineage.methods.get("__init__")
    place: ast.AST = init or cls
    if init is not None:
        known, takes_any = function_parameters(init)
    else:
        known, takes_any = list(lineage.fields()), lineage.has_unknown_base
    types = {name: annotation for name, annotation, _ in known}
    for name, value in values.items():
        if name not in types:
            if not takes_any:
                near = get_close_matches(name, list(types), 1)
                listed = f"its parameters: {', '.join(types)}" if types else "it has no parameters"
                help_text = f"did you mean `{near[0]}`?" if near else listed
                message = f"`{cls.name}` has no parameter `{name}`"
                yield MonitorFinding.at(place, lines, message, help_text, name)
            continue
        expected = _VALUE_TYPES.get(types[name])
        if expected and (not isinstance(value, expected) or _is_wrong_bool(value, expected)):
            message = f"parameter `{name}` of `{cls.name}` is of type {types[name]}, not {value!r}"
            yield MonitorFinding.at(place, lines, message, "", name)
    missing = [name for name, _, required in known if required and name not in values]
    if missing:
        text = ", ".join(f"`{name}`" for name in missing)
        word = "parameter" if len(missing) == 1 else "parameters"
        help_text = "write it in the block of the monitor: { " + f"{missing[0]} = …; }}"
        message = f"`{cls.name}` needs the {word} {text}"
        yield MonitorFinding.at(place, lines, message, help_text, missing[0])


def _is_wrong_bool(value: object, expected: tuple[type, ...]) -> bool:
    """A bool is an int for Python, but not for users."""
    return isinstance(value, bool) and bool not in expected


def _collect_events(lineage: _Lineage, check: HookCheck, result: MonitorClass) -> None:
    result.all_events_known = not lineage.has_unknown_base
    for cls in lineage.classes:
        for node in ast.walk(cls):
            match node:
                case ast.Call(
                    func=ast.Attribute(value=ast.Name(id="self"), attr="set_event"), args=[name, *_]
                ):
                    match name:
                        case ast.Constant(value=str(event)) if EVENT_NAME.fullmatch(event):
                            result.events.add(event)
                        case ast.Constant(value=value):
                            check.report(
                                name,
                                f"{value!r} is not the name of an event",
                                "an event is named like a variable, such as e_face",
                            )
                        case _:
                            result.all_events_known = False
                    check.check_lifetime(node)
