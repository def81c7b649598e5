"""What an IDSL module may not say although every name in it means something.

In: a resolved module. Out: findings.
"""

from __future__ import annotations

from robocomp_dsl.check import codes
from robocomp_dsl.check.patterns import is_response
from robocomp_dsl.check.resolve_idsl import Resolved
from robocomp_dsl.check.units import judge_unit
from robocomp_dsl.diagnostics import Edit, Fix, Note, Report
from robocomp_dsl.model import types
from robocomp_dsl.model.interface import Interface, Operation, Pattern
from robocomp_dsl.source import Span
from robocomp_dsl.syntax import ast_idsl as ast


def judge_idsl(resolved: Resolved, report: Report) -> None:
    """Report everything that is wrong with a module."""
    for tree, made in resolved.pairs:
        match tree, made:
            case ast.Enum(), types.Enum():
                _judge_enum(made, report)
            case ast.Dictionary(), types.Dictionary():
                _judge_key(tree, made, report)
            case ast.Field(), types.Field():
                if tree.unit:
                    is_number = _holds_number(made.type)
                    judge_unit(tree.unit, f"`{made.name}`", report, is_number=is_number)
            case ast.Operation(), Operation():
                _judge_operation(tree, made, report)
            case _, Interface():
                _judge_mixture(made, report)


def _judge_enum(made: types.Enum, report: Report) -> None:
    if not made.enumerators:
        report.add(codes.EMPTY_ENUM, made.span, f"the enumeration `{made.name}` has no values")
    first: dict[int, types.Enumerator] = {}
    for one in made.enumerators:
        earlier = first.setdefault(one.value, one)
        if earlier is not one:
            report.add(
                codes.REPEATED_ENUM_VALUE,
                one.span,
                f"`{one.name}` has the value {one.value}, as `{earlier.name}` has",
                notes=[Note(earlier.span, f"`{earlier.name}` is declared here")],
            )


def _judge_key(tree: ast.Dictionary, made: types.Dictionary, report: Report) -> None:
    if not _is_key(made.key):
        report.add(
            codes.DICTIONARY_KEY,
            tree.key.span,
            f"`{tree.key.text}` cannot be the key of a dictionary",
            help="a key is a whole number, a string, a bool, an enumeration or a struct of these",
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


def _holds_number(type_: types.Type) -> bool:
    match type_:
        case types.Primitive():
            return type_ in types.NUMBERS
        case types.Enum():
            return False
        case types.Sequence():
            return _holds_number(type_.element)
    return True


def _judge_operation(tree: ast.Operation, made: Operation, report: Report) -> None:
    for one in tree.params:
        param = next((p for p in made.inputs + made.outputs if p.name == one.name.text), None)
        if one.unit and param:
            is_number = _holds_number(param.type)
            judge_unit(one.unit, f"`{param.name}`", report, is_number=is_number)
    if made.pattern in (Pattern.COMMAND, Pattern.PUBLISH):
        _judge_one_way(tree, made, report)
    elif made.pattern is Pattern.QUERY and tree.pattern:
        _note_response(tree, made, report)


def _judge_one_way(tree: ast.Operation, made: Operation, report: Report) -> None:
    """A command and a publication travel one way: nothing can come back."""
    if tree.throws and tree.pattern:
        report.add(
            codes.UNHEARD_EXCEPTION,
            tree.throws[0].span.to(tree.throws[-1].span),
            f"who uses `{made.name}` never learns of this: a `[{made.pattern}]` is not answered",
            notes=[Note(tree.pattern.span, "marked here")],
            help="mark it `[query]` to wait until it is done, or remove `throws`",
            fix=Fix("mark it `[query]`", (Edit(tree.pattern.span, "query"),)),
        )
    found = _first_output(tree)
    if found is None or tree.pattern is None:
        return
    what, span = found
    report.add(
        codes.ONE_WAY_OUTPUT,
        span,
        f"`{made.name}` is a `[{made.pattern}]` and has {what}, but nothing comes back from it",
        notes=[Note(tree.pattern.span, "marked here")],
        help="mark it `[query]` to get an answer",
        fix=Fix("mark it `[query]`", (Edit(tree.pattern.span, "query"),)),
    )


def _first_output(tree: ast.Operation) -> tuple[str, Span] | None:
    if tree.result:
        return "a result", tree.result.span
    for param in tree.params:
        if param.out:
            return f"the output `{param.name.text}`", param.span
    return None


def _note_response(tree: ast.Operation, made: Operation, report: Report) -> None:
    """Say which parameter was taken for the response where its type does not say so."""
    if any(param.out for param in tree.params) or not made.outputs:
        return
    response = made.outputs[0]
    written = next(one for one in tree.params if one.name.text == response.name)
    if not is_response(response.type):
        report.add(
            codes.IMPLIED_RESPONSE,
            written.span,
            f"`{response.name}` is taken for the response of `{made.name}`",
            fix=Fix("write `out`", (Edit(written.span, f"out {written.span.text}"),)),
        )


def _judge_mixture(made: Interface, report: Report) -> None:
    """An interface is either a topic or a service; with both marks no port can use all of it."""
    topic = next((o for o in made.operations if o.pattern is Pattern.PUBLISH), None)
    service = next(
        (o for o in made.operations if o.pattern in (Pattern.COMMAND, Pattern.QUERY)), None
    )
    if topic and service:
        report.add(
            codes.MIXED_INTERFACE,
            made.span,
            f"no component can use all of `{made.name}`",
            notes=[
                Note(topic.span, f"`{topic.name}` can only be published"),
                Note(service.span, f"`{service.name}` can only be called"),
            ],
            help="declare the published operations in an interface of their own",
        )
