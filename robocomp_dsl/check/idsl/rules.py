"""The rules for a resolved IDSL module.

In: a resolved module. Out: diagnostics.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import types as codes
from robocomp_dsl.check.idsl.patterns import is_response
from robocomp_dsl.check.idsl.resolve import ResolvedModule
from robocomp_dsl.check.idsl.units import UnitCheck, check_suffix, check_unit, holds_number
from robocomp_dsl.diagnostics import Edit, Fix, Note, Report
from robocomp_dsl.model import types
from robocomp_dsl.model.interface import Interface, Operation, Pattern
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import idsl as ast


def check_idsl_rules(resolved: ResolvedModule, report: Report) -> None:
    """Check the rules of a module."""
    # The comments of imported definitions have texts in brackets that are no units.
    check = check_unit if resolved.module.origin else check_suffix
    for tree, resolved_node in resolved.pairs:
        match tree, resolved_node:
            case ast.Enum(), types.Enum():
                _check_enum(resolved_node, report)
            case ast.Dictionary(), types.Dictionary():
                _check_key(tree, resolved_node, report)
            case ast.Field(), types.Field():
                if tree.unit and resolved_node.unit:
                    is_number = holds_number(resolved_node.type)
                    check(tree.unit, f"`{resolved_node.name}`", report, is_number=is_number)
            case ast.Operation(), Operation():
                _check_operation(tree, resolved_node, report)
                _check_units(tree, resolved_node, check, report)
            case _, Interface():
                _check_mixed_patterns(resolved_node, report)


def _check_enum(enum: types.Enum, report: Report) -> None:
    if not enum.enumerators:
        report.add(codes.EMPTY_ENUM, enum.span, f"the enumeration `{enum.name}` has no values")
    first: dict[int, types.Enumerator] = {}
    for enumerator in enum.enumerators:
        earlier = first.setdefault(enumerator.value, enumerator)
        if earlier is not enumerator:
            report.add(
                codes.DUPLICATE_ENUM_VALUE,
                enumerator.span,
                f"`{enumerator.name}` has the same value {enumerator.value} as `{earlier.name}`",
                notes=[Note(earlier.span, f"`{earlier.name}` is declared here")],
            )


def _check_key(tree: ast.Dictionary, dictionary: types.Dictionary, report: Report) -> None:
    if not _is_key(dictionary.key):
        report.add(
            codes.DICTIONARY_KEY,
            tree.key.span,
            f"`{tree.key.text}` cannot be the key type of a dictionary",
            help="a key is an integer, a string, a bool, an enumeration or a struct of these",
        )


def _is_key(type_: types.Type) -> bool:
    match type_:
        case types.Primitive():
            return type_ not in (types.FLOAT, types.DOUBLE)
        case types.Enum():
            return True
        case types.Struct():
            return all(_is_key(field.type) for field in type_.fields)
    return False


def _check_units(
    tree: ast.Operation, operation: Operation, check: UnitCheck, report: Report
) -> None:
    for written in tree.params:
        if not written.unit:
            continue
        param = next(
            (p for p in operation.inputs + operation.outputs if p.name == written.name.text), None
        )
        if param:
            is_number = holds_number(param.type)
            check(written.unit, f"`{param.name}`", report, is_number=is_number)


def _check_operation(tree: ast.Operation, operation: Operation, report: Report) -> None:
    if operation.pattern in (Pattern.COMMAND, Pattern.PUBLISH):
        _check_one_way(tree, operation, report)
    elif operation.pattern is Pattern.QUERY and tree.pattern:
        _note_response(tree, operation, report)


def _check_one_way(tree: ast.Operation, operation: Operation, report: Report) -> None:
    """Report exceptions and outputs of a command or publication, which have no reply."""
    if tree.throws and tree.pattern:
        report.add(
            codes.EXCEPTION_WITHOUT_REPLY,
            tree.throws[0].span.cover(tree.throws[-1].span),
            f"callers never receive this exception: the `[{operation.pattern}]` "
            f"`{operation.name}` has no reply",
            notes=[Note(tree.pattern.span, "marked here")],
            help="mark it `[query]` to get a reply, or remove `throws`",
            fix=Fix("mark it `[query]`", (Edit(tree.pattern.span, "query"),)),
        )
    found = _first_output(tree)
    if found is None or tree.pattern is None:
        return
    output, span = found
    report.add(
        codes.ONE_WAY_OUTPUT,
        span,
        f"`{operation.name}` has {output}, but a `[{operation.pattern}]` has no reply",
        notes=[Note(tree.pattern.span, "marked here")],
        help="mark it `[query]` to get a reply",
        fix=Fix("mark it `[query]`", (Edit(tree.pattern.span, "query"),)),
    )


def _first_output(tree: ast.Operation) -> tuple[str, Span] | None:
    if tree.result:
        return "a result", tree.result.span
    for param in tree.params:
        if param.out:
            return f"the output `{param.name.text}`", param.span
    return None


def _note_response(tree: ast.Operation, operation: Operation, report: Report) -> None:
    """Report a parameter that is interpreted as the response although its type has another name."""
    if any(param.out for param in tree.params) or not operation.outputs:
        return
    response = operation.outputs[0]
    written = next(parameter for parameter in tree.params if parameter.name.text == response.name)
    if not is_response(response.type):
        report.add(
            codes.IMPLIED_RESPONSE,
            written.span,
            f"`{response.name}` is interpreted as the response of `{operation.name}`",
            fix=Fix("write `out`", (Edit(written.span, f"out {written.span.text}"),)),
        )


def _check_mixed_patterns(interface: Interface, report: Report) -> None:
    """An interface is either a topic or a service; no port can use all of a mixed one."""
    topic = next((o for o in interface.operations if o.pattern is Pattern.PUBLISH), None)
    service = next(
        (o for o in interface.operations if o.pattern in (Pattern.COMMAND, Pattern.QUERY)), None
    )
    if topic and service:
        report.add(
            codes.MIXED_INTERFACE,
            interface.span,
            f"no component can use all of `{interface.name}`",
            notes=[
                Note(topic.span, f"`{topic.name}` can only be published"),
                Note(service.span, f"`{service.name}` can only be called"),
            ],
            help="move the published operations to another interface",
        )
