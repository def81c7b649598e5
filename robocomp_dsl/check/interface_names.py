"""Names of interfaces in a component.

In: a name as written. Out: the interface that it means, or None after a finding.
"""

from __future__ import annotations

from robocomp_dsl.check import codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.visible import Visible
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.model.types import Declaration
from robocomp_dsl.syntax.ast_base import QualifiedName


def find_interface(name: QualifiedName, visible: Visible, report: Report) -> Interface | None:
    """The interface called `name`: of a direct import, else of what these import.

    Of several that of the file with its name, as RoboComp has it: its AGMExecutive.idsl and
    AGMExecutiveTopic.idsl both declare an AGMExecutiveTopic, and every agent imports both.
    """
    found = visible.find(name, Interface)
    found = [one for one in found if one.span.source.path.stem == one.name] or found
    if len(found) == 1:
        return found[0]
    if found:
        _report_ambiguous(name, found, report)
    else:
        _report_unknown(name, visible, report)
    return None


def _report_ambiguous(name: QualifiedName, found: list[Interface], report: Report) -> None:
    choices = list(dict.fromkeys(one.qualified for one in found))
    report.add(
        codes.AMBIGUOUS_INTERFACE,
        name.span,
        f"`{name.text}` can mean {listing(choices)}"
        if len(choices) > 1
        else f"several imported files declare `{choices[0]}`",
        notes=[Note(one.span, f"`{one.qualified}` is declared here") for one in found],
        help="write the module in front of it" if len(choices) > 1 else "import only one",
    )


def _report_unknown(name: QualifiedName, visible: Visible, report: Report) -> None:
    others = visible.find(name, Declaration)
    if others:
        report.add(
            codes.NOT_AN_INTERFACE,
            name.span,
            f"`{name.text}` is not an interface",
            notes=[Note(others[0].span, "it is declared here")],
        )
        return
    known = [one.name for one in visible.declarations(Interface)]
    guess = nearest(name.name.text, known)
    if visible.is_excused(name, guess):
        return
    same_letters = guess is not None and guess.lower() == name.text.lower()
    offer = None if same_letters else visible.importable(name)
    if offer is not None:
        report.add(
            codes.INTERFACE_NOT_IMPORTED,
            name.span,
            f"interface `{name.text}` is not imported",
            help=offer.help,
            fix=offer.fix,
        )
        return
    declared = [one for one in visible.declarations(Interface) if one.name == guess]
    report.add(
        codes.UNKNOWN_INTERFACE,
        name.span,
        f"interface `{name.text}` is not declared by any import",
        label=f"did you mean `{guess}`?" if guess else "",
        notes=[Note(one.span, f"`{one.name}` is declared here") for one in declared],
        help="" if guess else f"the imports declare {listing(known) or 'no interface'}",
        fix=replace(name.span, guess) if guess else None,
    )
