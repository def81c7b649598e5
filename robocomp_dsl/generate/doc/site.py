"""The pages of all models, and the users of interfaces.

In: a `DocumentationSubject`. Out: `DocumentationSite` with the targets of links, deterministic.
Copies of a file, which deployments of several folders often have, are one page.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TypeAlias

from robocomp_dsl.generate.doc.nodes import InlineCode, Inlines
from robocomp_dsl.generate.doc.subject import DocumentationSubject
from robocomp_dsl.generate.doc.target import Target
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.model.interface import Interface, Module
from robocomp_dsl.model.parameter import ParameterSet
from robocomp_dsl.model.statemachine import StateMachine
from robocomp_dsl.model.types import Declaration, Primitive, Sequence, Type

MAX_NAME_LENGTH = 80

PagedModel: TypeAlias = Bridge | Component | Deployment | ParameterSet | StateMachine


class AnchorNames:
    """Unique names of anchors and pages, regardless of case, with characters `A-Za-z0-9_.-`."""

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def claim(self, name: str) -> str:
        """`name`, or `name` with a number if it is taken."""
        plain = re.sub(r"[^A-Za-z0-9_.-]", "_", name)[:MAX_NAME_LENGTH].lstrip(".") or "_"
        name, count = plain, 1
        while name.lower() in self._taken:
            count += 1
            name = f"{plain}-{count}"
        self._taken.add(name.lower())
        return name


@dataclass(frozen=True, slots=True)
class DocumentationSite:
    """Targets of links, by the identity of their models. `modules` have no copies."""

    subject: DocumentationSubject
    modules: tuple[Module, ...]
    _pages: Mapping[int, str]
    _declaration_targets: Mapping[int, Target]

    def page(self, model: PagedModel | Module) -> str:
        """The path of the model's page, without suffix."""
        return self._pages[id(model)]

    def target(self, declaration: Declaration) -> Target:
        """Where an interface, a type or an exception is described."""
        return self._declaration_targets[id(declaration)]

    def with_local_anchors(self, anchors: Mapping[int, str]) -> DocumentationSite:
        """The site for a page that describes types itself; `anchors` are by identity of a type."""
        local = {identity: Target("", anchor) for identity, anchor in anchors.items()}
        return replace(self, _declaration_targets={**self._declaration_targets, **local})

    def users(self, interface: Interface) -> list[tuple[Component, Port]]:
        """Components and their ports that use this interface."""
        page = self.target(interface)
        ports = (
            (component, port) for component in self.subject.components for port in component.ports
        )
        return [(user, port) for user, port in ports if self.target(port.interface) == page]

    def link(self, model: PagedModel | Module) -> Inlines:
        """The model's name as a link to its page."""
        return (InlineCode(model.name, Target(self.page(model))),)

    def declaration_link(self, declaration: Declaration) -> Inlines:
        """The name of an interface, type or exception as a link to its description."""
        return (InlineCode(declaration.name, self.target(declaration)),)

    def type_link(self, type_: Type) -> Inlines:
        """The name of a type, as a link unless it is built in."""
        if isinstance(type_, Sequence) and type_.is_anonymous:
            brackets = type_.name[type_.name.rindex("[") :]
            return (*self.type_link(type_.element), InlineCode(brackets))
        return (
            (InlineCode(type_.name),)
            if isinstance(type_, Primitive)
            else self.declaration_link(type_)
        )


def build_site(subject: DocumentationSubject) -> DocumentationSite:
    """The pages of everything in `subject`."""
    pages: dict[int, str] = {}
    _assign_pages(pages, "components", subject.components)
    pages |= {copy: pages[id(model)] for copy, model in subject.canonical_components.items()}
    _assign_pages(pages, "deployments", subject.deployments)
    _assign_pages(pages, "bridges", subject.bridges)
    _assign_pages(pages, "parameters", subject.parameters)
    _assign_pages(pages, "statemachines", subject.machines)
    first: dict[tuple[str, str, int], Module] = {}
    for module in subject.modules:
        first.setdefault(_module_key(module), module)
    modules = tuple(first.values())
    _assign_pages(pages, "modules", modules)
    declared = _declaration_targets(modules, pages)
    for module in subject.modules:
        pages[id(module)] = pages[id(first[_module_key(module)])]
        for copy, original in zip(
            module.declarations, first[_module_key(module)].declarations, strict=True
        ):
            declared[id(copy)] = declared[id(original)]
    return DocumentationSite(subject, modules, pages, declared)


def type_anchor(declaration: Declaration) -> str:
    """The anchor of a type or exception in its module's page."""
    return f"type.{declaration.name}"


def _module_key(module: Module) -> tuple[str, str, int]:
    return module.name, module.span.source.text, module.span.start


def _assign_pages(
    pages: dict[int, str], folder: str, models: Iterable[PagedModel | Module]
) -> None:
    names = AnchorNames()
    for model in models:
        pages[id(model)] = f"{folder}/{names.claim(model.name)}"


def _declaration_targets(modules: Iterable[Module], pages: Mapping[int, str]) -> dict[int, Target]:
    names = AnchorNames()
    targets: dict[int, Target] = {}
    for module in modules:
        for declaration in module.declarations:
            if isinstance(declaration, Interface):
                page = f"interfaces/{names.claim(f'{module.name}.{declaration.name}')}"
                targets[id(declaration)] = Target(page)
            else:
                targets[id(declaration)] = Target(pages[id(module)], type_anchor(declaration))
    return targets
