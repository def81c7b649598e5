"""Resolves names of interfaces in a component.

In: a name. Out: the interface, or None and a diagnostic.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.import_scope import ImportScope
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.model.types import Declaration
from robocomp_dsl.syntax.ast.base import QualifiedName


def find_interface(name: QualifiedName, scope: ImportScope, report: Report) -> Interface | None:
    """The interface called `name`: of a direct import, else of an indirect one.

    Of several, the one in the file with its name: RoboComp's AGMExecutive.idsl and
    AGMExecutiveTopic.idsl both declare AGMExecutiveTopic, and every agent imports both.
    """
    matches = scope.lookup(name, Interface)
    matches = [
        interface for interface in matches if interface.span.source.path.stem == interface.name
    ] or matches
    if len(matches) == 1:
        return matches[0]
    if matches:
        _report_ambiguous(name, matches, report)
    else:
        _report_unknown(name, scope, report)
    return None


def _report_ambiguous(name: QualifiedName, matches: list[Interface], report: Report) -> None:
    choices = list(dict.fromkeys(interface.qualified for interface in matches))
    report.add(
        codes.AMBIGUOUS_INTERFACE,
        name.span,
        f"`{name.text}` is ambiguous: {join_names(choices)}"
        if len(choices) > 1
        else f"several imported files declare `{choices[0]}`",
        notes=[
            Note(interface.span, f"`{interface.qualified}` is declared here")
            for interface in matches
        ],
        help="write the module before it" if len(choices) > 1 else "import only one",
    )


def _report_unknown(name: QualifiedName, scope: ImportScope, report: Report) -> None:
    others = scope.lookup(name, Declaration)
    if others:
        report.add(
            codes.NOT_AN_INTERFACE,
            name.span,
            f"`{name.text}` is not an interface",
            notes=[Note(others[0].span, "it is declared here")],
        )
        return
    known = [interface.name for interface in scope.declarations(Interface)]
    guess = nearest(name.name.text, known)
    if scope.is_follow_on_error(name, guess):
        return
    same_letters = guess is not None and guess.lower() == name.text.lower()
    offer = None if same_letters else scope.suggest_import(name)
    if offer is not None:
        report.add(
            codes.INTERFACE_NOT_IMPORTED,
            name.span,
            f"interface `{name.text}` is not imported",
            help=offer.help,
            fix=offer.fix,
        )
        return
    declared = [interface for interface in scope.declarations(Interface) if interface.name == guess]
    report.add(
        codes.UNKNOWN_INTERFACE,
        name.span,
        f"interface `{name.text}` is not declared by any import",
        label=f"did you mean `{guess}`?" if guess else "",
        notes=[
            Note(interface.span, f"`{interface.name}` is declared here") for interface in declared
        ],
        help="" if guess else f"the imports declare {join_names(known) or 'no interface'}",
        fix=replace_fix(name.span, guess) if guess else None,
    )
