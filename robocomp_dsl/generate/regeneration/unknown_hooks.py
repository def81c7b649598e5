"""Reports methods named like hooks that are never called, because no such name exists.

In: the user's module, the parameters and the state machine of the component. Out: findings about
`will_set_x` and `did_set_x` of fixed or unknown parameters, `on_enter_x` etc. of unknown states.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from typing import NamedTuple

from robocomp_dsl.diagnostics import Code, Report, did_you_mean, nearest
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.python.machine_code import METHODS, MachineCode
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.model.parameter import Kind, Parameter

SETTERS = ("will_set_", "did_set_")


class _Kind(NamedTuple):
    """The hooks with one prefix; `of` maps the rest of a name to the problem."""

    what: str
    code: Code
    of: dict[str, str]


def report_unknown_hooks(
    user: UserModule,
    parameters: Iterable[Parameter],
    machine: MachineCode | None,
    known: Collection[str],
    report: Report,
) -> None:
    """Check the user's class and its bases; methods in `known` are checked elsewhere."""
    hooks = dict(_hooks(parameters))
    kinds = {prefix: _Kind("parameter", codes.UNKNOWN_PARAMETER, hooks) for prefix in SETTERS}
    if machine:
        states = {m.name.removeprefix("state_"): "" for m in machine.of_verb("state")}
        kinds |= {f"{v}_": _Kind("state", codes.UNKNOWN_EVENT, states) for v in METHODS}
    for name, member in user.members.items():
        prefix = next((candidate for candidate in kinds if name.startswith(candidate)), "")
        if not prefix or member is None or name in known:
            continue
        kind, rest = kinds[prefix], name.removeprefix(prefix)
        wrong = kind.of.get(rest, f"there is no {kind.what} `{rest}`")
        # Other methods may start with `state_`, too; only similar names are misspellings.
        if wrong and (prefix != "state_" or nearest(rest, kind.of)):
            message = f"`{name}` is never called: {wrong}"
            label = did_you_mean(rest, kind.of) if rest not in kind.of else ""
            report.add(kind.code, member.span, message, label=label)


def _hooks(parameters: Iterable[Parameter], path: str = "") -> Iterator[tuple[str, str]]:
    """The suffixes of the hooks, and why a hook is never called."""
    for parameter in parameters:
        name = f"{path}{parameter.name}"
        if parameter.kind is Kind.GROUP:
            yield from _hooks(parameter.members, f"{name}_")
        else:
            yield (
                name,
                "" if parameter.live else f"`{parameter.name}` is not live, it never changes",
            )
