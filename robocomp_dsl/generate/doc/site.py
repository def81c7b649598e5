"""Which page everything is on, and who uses an interface.

In: a `Subject`. Out: `Site`: targets of links, the same for the same subject. Two copies of one
file, which deployments of several folders often see, are one page.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TypeAlias

from robocomp_dsl.generate.doc.subject import Subject
from robocomp_dsl.generate.doc.words import Code, Target, Words
from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.model.interface import Interface, Module
from robocomp_dsl.model.parameter import ParameterSet
from robocomp_dsl.model.statemachine import StateMachine
from robocomp_dsl.model.types import Declaration, Primitive, Type

LONGEST_NAME = 80

Paged: TypeAlias = Component | Deployment | ParameterSet | StateMachine


class Names:
    """Names that differ from each other, whatever the case, and hold only `A-Za-z0-9_.-`."""

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def claim(self, wanted: str) -> str:
        """`wanted`, or the next name like it that is free."""
        plain = re.sub(r"[^A-Za-z0-9_.-]", "_", wanted)[:LONGEST_NAME].lstrip(".") or "_"
        name, count = plain, 1
        while name.lower() in self._taken:
            count += 1
            name = f"{plain}-{count}"
        self._taken.add(name.lower())
        return name


@dataclass(frozen=True, slots=True)
class Site:
    """Targets of links, by the identity of what they lead to. `modules` have no copies."""

    subject: Subject
    modules: tuple[Module, ...]
    _pages: Mapping[int, str]
    _declared: Mapping[int, Target]

    def page(self, one: Paged | Module) -> str:
        """The path of its page, without suffix."""
        return self._pages[id(one)]

    def target(self, one: Declaration) -> Target:
        """Where an interface, a type or an exception is described."""
        return self._declared[id(one)]

    def showing(self, anchors: Mapping[int, str]) -> Site:
        """As seen from a page that describes some types itself; their anchors by identity."""
        local = {one: Target("", anchor) for one, anchor in anchors.items()}
        return replace(self, _declared={**self._declared, **local})

    def users(self, interface: Interface) -> list[tuple[Component, Port]]:
        """Components and their ports that speak of this interface."""
        page = self.target(interface)
        ports = ((one, port) for one in self.subject.components for port in one.ports)
        return [(one, port) for one, port in ports if self.target(port.interface) == page]

    def link(self, one: Paged | Module) -> Words:
        """Its name, leading to its page."""
        return (Code(one.name, Target(self.page(one))),)

    def declared(self, one: Declaration) -> Words:
        """The name of an interface, type or exception, leading to where it is described."""
        return (Code(one.name, self.target(one)),)

    def type(self, type_: Type) -> Words:
        """The name of a type, as a link unless it is built in."""
        return (Code(type_.name),) if isinstance(type_, Primitive) else self.declared(type_)


def site_of(subject: Subject) -> Site:
    """The pages of everything in `subject`."""
    pages: dict[int, str] = {}
    _place(pages, "components", subject.components)
    pages |= {copy: pages[id(one)] for copy, one in subject.same.items()}
    _place(pages, "deployments", subject.deployments)
    _place(pages, "parameters", subject.parameters)
    _place(pages, "statemachines", subject.machines)
    first: dict[tuple[str, str, int], Module] = {}
    for one in subject.modules:
        first.setdefault(_key(one), one)
    modules = tuple(first.values())
    _place(pages, "modules", modules)
    declared = _declarations(modules, pages)
    for one in subject.modules:
        pages[id(one)] = pages[id(first[_key(one)])]
        for copy, original in zip(one.declarations, first[_key(one)].declarations, strict=True):
            declared[id(copy)] = declared[id(original)]
    return Site(subject, modules, pages, declared)


def type_anchor(one: Declaration) -> str:
    """The place of a type or exception in its module's page."""
    return f"type.{one.name}"


def _key(module: Module) -> tuple[str, str, int]:
    return module.name, module.span.source.text, module.span.start


def _place(pages: dict[int, str], folder: str, ones: Iterable[Paged | Module]) -> None:
    names = Names()
    for one in ones:
        pages[id(one)] = f"{folder}/{names.claim(one.name)}"


def _declarations(modules: Iterable[Module], pages: Mapping[int, str]) -> dict[int, Target]:
    names = Names()
    made: dict[int, Target] = {}
    for module in modules:
        for one in module.declarations:
            if isinstance(one, Interface):
                page = f"interfaces/{names.claim(f'{module.name}.{one.name}')}"
                made[id(one)] = Target(page)
            else:
                made[id(one)] = Target(pages[id(module)], type_anchor(one))
    return made
