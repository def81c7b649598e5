"""Compares the user's class with the component: missing, stale and changed methods.

In: the user's module, the required methods, the signatures it was written for. Out: the methods
without a `def`, and findings about the others.

Names and annotations of parameters that the user changed are accepted: a changed signature is only
reported if the user's `def` has what was generated before and is not generated now, or if a call
would fail.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence

from robocomp_dsl.diagnostics import Report, nearest
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.regeneration.hierarchy import BASE, CLASS
from robocomp_dsl.generate.regeneration.methods import Method, Signature
from robocomp_dsl.generate.regeneration.python_module import Function
from robocomp_dsl.generate.regeneration.user_module import UserMethod, UserModule

_PLAIN = {"override", "typing.override"}
"""Decorators that do not change a signature."""


def missing_methods(
    user: UserModule,
    methods: Mapping[str, Method],
    known: Mapping[str, Signature],
    report: Report,
) -> Iterator[Method]:
    """The methods that the class lacks; findings about existing ones go to `report`.

    A method that a base from another folder may have is only missing if it is new, and so is a
    method of a state: users may delete these.
    """
    has = user.members
    for name, method in methods.items():
        if name not in has:
            is_old = name in known and (user.hierarchy.unknown or not method.code.call)
            if not method.optional and not is_old and legacy_name(name) not in has:
                yield method
        elif (member := has[name]) is not None:
            _judge_signature(member, method, known.get(name), report)
    for name in known.keys() - methods.keys() & has.keys():
        if (member := has[name]) is not None:
            _report_stale(user, member, methods, report)


def legacy_name(name: str) -> str:
    """The name that RoboComp gave to the method of a state: `sm_search` for `state_search`."""
    return re.sub(r"^state_", "sm_", name)


def report_missing(
    user: UserModule,
    missing: Sequence[Method],
    methods: Mapping[str, Method],
    why: str,
    package: str,
    report: Report,
) -> None:
    """Report the missing methods, and `why` no stubs are added, or what would be added."""
    worker = user.hierarchy.classes[0] if user.hierarchy.classes else None
    where = worker[0].span_of(worker[1]) if worker else user.source.file_span
    name = worker[1].name if worker else CLASS
    for method in missing:
        guess = similar_method(user, method, methods)
        report.add(
            codes.MISSING_METHOD,
            where,
            f"`{name}` has no method `{method.name}` for {method.what}; {why}",
            label=f"did you mean `{guess}`?" if guess else "",
            notes=[method.origin],
            help=f"`{BASE}` in {package}/genericworker.py has its signature",
        )


def similar_method(user: UserModule, missing: Method, methods: Mapping[str, Method]) -> str | None:
    """A method of the user that is probably a renamed or misspelt `one`."""
    free = user.members.keys() - methods.keys()
    return nearest(missing.name, sorted(n for n in free if n.startswith(missing.prefix)))


def matches_signature(function: Function, old: Signature, new: Signature) -> bool:
    """Whether a `def` has nothing left of `old` that is not in `new`."""
    return _callable_with(function, len(new.arguments)) and not _leftovers(function, old, new)


def _judge_signature(
    member: UserMethod, method: Method, old: Signature | None, report: Report
) -> None:
    new, function = method.signature, member.function
    if any(ast.unparse(d) not in _PLAIN for d in function.decorator_list) and not (
        old and matches_signature(function, old, old)
    ):
        return  # a decorator may change the signature, and did before
    if matches_signature(function, old or new, new):
        return
    mine = f"def {function.name}{_shown(function)}"
    report.add(
        codes.CHANGED_SIGNATURE,
        member.span,
        f"the signature of `{function.name}` has changed",
        label=", ".join(_differences(function, old or new, new)),
        notes=[method.origin],
        help=f"old: {mine}\n      new: def {function.name}{_with_self(new)}",
    )


def _report_stale(
    user: UserModule, member: UserMethod, methods: Mapping[str, Method], report: Report
) -> None:
    name = member.function.name
    guess = nearest(name, (n for n in methods if n not in user.members))
    renamed = f"was it renamed to `{guess}`? " if guess else ""
    report.add(
        codes.STALE_METHOD,
        member.span,
        f"`{name}` is stale: its operation or state no longer exists",
        help=f"{renamed}move the code you need and delete the method; rcgen never deletes it",
    )


def _callable_with(function: Function, count: int) -> bool:
    """Whether it can be called with `self` and so many positional arguments."""
    a = function.args
    positional = len(a.posonlyargs) + len(a.args)
    needed = positional - len(a.defaults)
    forced = any(default is None for default in a.kw_defaults)
    enough = a.vararg is not None or positional >= count + 1
    return enough and needed <= count + 1 and not forced


def _leftovers(function: Function, old: Signature, new: Signature) -> list[str]:
    """The parts of `old` that the `def` still has although `new` differs."""
    a = function.args
    mine = [*a.posonlyargs, *a.args][1:]
    found = []
    for argument, was, now in zip(mine, old.arguments, new.arguments, strict=False):
        if argument.arg == was[0] != now[0]:
            found.append(f"`{was[0]}` is `{now[0]}`")
        if _annotation(argument.annotation) == was[1] != now[1]:
            found.append(f"`{now[0]}` is of type {now[1]}")
    if _annotation(function.returns) == old.returns != new.returns:
        found.append(f"it returns {new.returns}")
    return found


def _differences(function: Function, old: Signature, new: Signature) -> list[str]:
    if not _callable_with(function, len(new.arguments)):
        count = len(new.arguments)
        return [f"it is called with {count} argument{'s' if count != 1 else ''}"]
    return _leftovers(function, old, new)


def _annotation(node: ast.expr | None) -> str:
    """A normalised annotation: without quotes and module names."""
    if node is None:
        return ""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value.strip()
    return ast.unparse(_Bare().visit(ast.parse(ast.unparse(node), mode="eval")).body)


class _Bare(ast.NodeTransformer):
    def visit_Attribute(self, node: ast.Attribute) -> ast.expr:
        return ast.Name(node.attr, ast.Load())


def _shown(function: Function) -> str:
    returns = f" -> {ast.unparse(function.returns)}" if function.returns else ""
    return f"({ast.unparse(function.args)}){returns}"


def _with_self(signature: Signature) -> str:
    text = str(signature)
    return f"(self, {text[1:]}" if signature.arguments else f"(self{text[1:]}"
