"""Checks the methods of a monitor's class: which hooks they are, and their signatures."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from difflib import get_close_matches
from typing import TypeAlias

from robocomp_dsl.monitors.monitor_finding import MonitoredOperation, MonitorFinding

Function: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef
Parameter: TypeAlias = tuple[str, str, bool]
"""Name, annotation, and whether it is required."""

HOOKS = {
    "on_create": (),
    "on_destroy": (),
    "accept": ("operation", "arguments"),
    "update": ("operation", "arguments"),
}
PREFIXES = ("accept_", "update_")
_CHECKED_TYPES = ("bool", "int", "float", "str")


def annotation_name(node: ast.expr | None) -> str:
    """The annotation as text, without quotes; "" without one."""
    if node is None:
        return ""
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, str) else str(node.value)
    return ast.unparse(node)


def function_parameters(function: Function) -> tuple[list[Parameter], bool]:
    """The parameters of a method without `self`, and whether it takes any keyword."""
    arguments = function.args
    positional = [*arguments.posonlyargs, *arguments.args]
    first_default = len(positional) - len(arguments.defaults)
    parameters = [
        (argument.arg, annotation_name(argument.annotation), i < first_default)
        for i, argument in enumerate(positional)
    ][1:]
    parameters += [
        (argument.arg, annotation_name(argument.annotation), default is None)
        for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
    ]
    return parameters, arguments.kwarg is not None


class HookCheck:
    """The findings of one class."""

    def __init__(self, lines: list[str], operations: Sequence[MonitoredOperation]) -> None:
        self._lines = lines
        self._operations = {operation.name: operation for operation in operations}
        self.findings: list[MonitorFinding] = []

    def report(self, node: ast.AST, message: str, help_text: str = "") -> None:
        """Add a finding at `node`."""
        self.findings.append(MonitorFinding.at(node, self._lines, message, help_text))

    def check_method(self, method: Function) -> None:
        """Check a method if it is, or seems to be, a hook."""
        name = method.name
        if name in HOOKS:
            inputs = tuple((parameter, "") for parameter in HOOKS[name])
        elif name.startswith(PREFIXES):
            operation = self._operation(method)
            if operation is None:
                return
            inputs = operation.inputs
            if name.startswith("update_") and not inputs:
                self.report(method, f"`{operation.name}` has no arguments to update")
                return
        else:
            self._check_name(method)
            return
        if isinstance(method, ast.AsyncFunctionDef):
            self.report(method, f"`{name}` must not be async", "write `def` without `async`")
            return
        if method.decorator_list:
            return  # a decorator may change the signature
        self._check_inputs(method, inputs)
        if name.startswith(("accept", "update")):
            self._check_result(method)

    def _operation(self, method: Function) -> MonitoredOperation | None:
        prefix, _, name = method.name.partition("_")
        if name in self._operations:
            return self._operations[name]
        near = get_close_matches(name, list(self._operations), 1)
        listed = ", ".join(self._operations)
        help_text = f"did you mean `{prefix}_{near[0]}`?" if near else f"its operations: {listed}"
        self.report(method, f"the interface has no operation `{name}`", help_text)
        return None

    def _check_name(self, method: Function) -> None:
        near = get_close_matches(method.name, list(HOOKS), 1, 0.8)
        if near:
            message = f"`{method.name}` is never called"
            self.report(method, message, f"did you mean `{near[0]}`?")

    def _check_inputs(self, method: Function, inputs: tuple[tuple[str, str], ...]) -> None:
        arguments = method.args
        positional = [*arguments.posonlyargs, *arguments.args]
        required = len(positional) - len(arguments.defaults)
        count = len(inputs) + 1
        too_many = len(positional) < count and arguments.vararg is None
        keyword = any(default is None for default in arguments.kw_defaults)
        if too_many or required > count or keyword:
            names = ", ".join(("self", *(name for name, _ in inputs)))
            message = f"`{method.name}` must take ({names})"
            self.report(method, message, f"def {method.name}({names})")
            return
        for argument, (name, type_) in zip(positional[1:], inputs, strict=False):
            annotation = annotation_name(argument.annotation)
            if annotation not in _CHECKED_TYPES or not type_ or annotation == type_:
                continue
            if (annotation, type_) != ("float", "int"):
                self.report(argument, f"`{name}` is of type {type_}, not {annotation}")

    def _check_result(self, method: Function) -> None:
        is_accept = method.name.startswith("accept")
        annotation = annotation_name(method.returns)
        if is_accept and annotation not in {"", "bool", "Any", "np.bool_"}:
            self.report(method, f"`{method.name}` returns a bool, not {annotation}")
        elif not is_accept and annotation == "None":
            self.report(method, f"`{method.name}` returns the arguments, not None")
        elif not any(_returned_values(method.body)) and not isinstance(method.body[-1], ast.Raise):
            expected = "True or False" if is_accept else "the arguments"
            self.report(method, f"`{method.name}` returns nothing; it must return {expected}")

    def check_lifetime(self, call: ast.Call) -> None:
        """Check the lifetime of a `set_event`, if it is a number."""
        keywords = (keyword.value for keyword in call.keywords if keyword.arg == "lifetime")
        lifetime = next(iter((*call.args[1:2], *keywords)), None)
        match lifetime:
            case ast.Constant(value=bool() | int() | float() as seconds) if seconds <= 0:
                self.report(lifetime, f"a lifetime is more than 0 s, not {seconds}")
            case ast.UnaryOp(op=ast.USub(), operand=ast.Constant()):
                self.report(lifetime, f"a lifetime is more than 0 s, not {ast.unparse(lifetime)}")


def _returned_values(body: Sequence[ast.stmt]) -> Iterator[ast.expr]:
    """The values that a function returns, without those of functions in it."""
    pending: list[ast.AST] = list(body)
    while pending:
        node = pending.pop()
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.Lambda):
            continue
        if isinstance(node, ast.Return) and node.value is not None:
            yield node.value
        pending.extend(ast.iter_child_nodes(node))
