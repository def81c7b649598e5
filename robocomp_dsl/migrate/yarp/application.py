"""Reads applications of yarpmanager.

In: a file. Out: its modules, connections and nested applications as data, and findings about
invalid and unknown elements. Texts have their variables replaced.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.yarp import codes
from robocomp_dsl.migrate.yarp.document import (
    attribute,
    child,
    children,
    name_of,
    read_document,
    text_of,
)
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast.innermodel import Element

_VARIABLE = re.compile(r"\$\{([^{}]*)\}|\$ENV\{([^{}]*)\}")
_KNOWN = ("name", "description", "version", "authors", "var", "prefix", "dependencies", "geometry")
_TEXTS = (
    "tag",
    "parameters",
    "node",
    "stdio",
    "workdir",
    "prefix",
    "environment",
    "display",
    "rank",
)
_KNOWN_OF_MODULE = (
    *("name", "deployer", "broker", "geometry", "dependencies", "ensure", "portmap", "description"),
    *_TEXTS,
)
_KNOWN_OF_CONNECTION = ("from", "to", "output", "input", "protocol", "geometry", "description")


@dataclass(frozen=True, slots=True)
class PortDependency:
    """A port that must exist; `timeout_s` 0: not stated. `request`: what the port must answer."""

    port: str
    timeout_s: float
    request: str
    span: Span


@dataclass(frozen=True, slots=True)
class ModuleEntry:
    """One program. Empty texts are not stated; `wait_s`: time after its start."""

    name: str
    span: Span
    tag: str = ""
    parameters: str = ""
    node: str = ""
    stdio: str = ""
    workdir: str = ""
    deployer: str = ""
    prefix: str = ""
    environment: str = ""
    display: str = ""
    rank: str = ""
    wait_s: float = 0.0
    stop_wait_s: float = 0.0
    dependencies: tuple[PortDependency, ...] = ()
    portmaps: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class ConnectionEntry:
    """A connection; an external end gets no prefix."""

    source: str
    target: str
    carrier: str
    span: Span
    source_external: bool = False
    target_external: bool = False
    persistent: bool = False
    qos: str = ""


@dataclass(frozen=True, slots=True)
class NestedApplication:
    """Another application, by its name, below a prefix."""

    name: str
    prefix: str
    span: Span


@dataclass(slots=True)
class Application:
    """One file of yarpmanager."""

    name: str
    span: Span
    description: str = ""
    version: str = ""
    authors: list[str] = field(default_factory=list)
    ports: list[PortDependency] = field(default_factory=list)
    modules: list[ModuleEntry] = field(default_factory=list)
    nested: list[NestedApplication] = field(default_factory=list)
    connections: list[ConnectionEntry] = field(default_factory=list)
    arbitrators: list[tuple[str, Span]] = field(default_factory=list)


def read_application(
    source: Source, report: Report, environment: Mapping[str, str] = os.environ
) -> Application | None:
    """The application of a file; None if it has no root element."""
    root = read_document(source, report)
    if root is None:
        return None
    return _Reader(source, report, environment).application(root)


class _Reader:
    """Reads one file; `_variables` are those of its `<var>` elements."""

    def __init__(self, source: Source, report: Report, environment: Mapping[str, str]) -> None:
        self._source = source
        self._report = report
        self._environment = environment
        self._variables: dict[str, str] = {}

    def application(self, root: Element) -> Application:
        for element in children(root, "var"):
            self._variables[attribute(element, "name")] = self._text(element)
        name = self._text(child(root, "name"))
        if not name:
            message = "the application has no `<name>`; it is named after its file"
            self._report.add(codes.SETTING_DROPPED, root.tag.span, message)
        application = Application(name or self._source.path.stem.partition(".")[0], root.tag.span)
        application.description = self._text(child(root, "description"))
        application.version = self._text(child(root, "version"))
        for authors in children(root, "authors"):
            application.authors += filter(None, map(self._author, children(authors, "author")))
        for dependencies in children(root, "dependencies"):
            application.ports += self._dependencies(dependencies)
        for element in root.children:
            self._item(element, application)
        return application

    def _item(self, element: Element, application: Application) -> None:
        match name_of(element):
            case "module":
                if module := self._module(element):
                    application.modules.append(module)
            case "connection":
                if connection := self._connection(element):
                    application.connections.append(connection)
            case "application":
                if nested := self._nested(element):
                    application.nested.append(nested)
            case "arbitrator":
                port = self._text(child(element, "port"))
                application.arbitrators.append((port, element.tag.span))
            case "prefix" if text := self._text(element):
                message = f"`<prefix>{text:.60}</prefix>` of the application has no effect in YARP"
                self._report.add(codes.SETTING_DROPPED, element.tag.span, message)
            case name if name not in _KNOWN:
                self._unknown(element)

    def _unknown(self, element: Element) -> None:
        message = f"`<{element.tag.text:.60}>` is unknown, and was ignored"
        self._report.add(codes.UNKNOWN_ELEMENT, element.tag.span, message)

    def _text(self, element: Element | None) -> str:
        """The text of an element with its variables replaced."""
        return _VARIABLE.sub(lambda match: self._value(match, element), text_of(element))

    def _value(self, match: re.Match[str], element: Element | None) -> str:
        known: Mapping[str, str] = self._variables if match[1] is not None else self._environment
        name = match[1] if match[1] is not None else match[2]
        span = element.tag.span if element else self._source.file_span
        if name not in known:
            message = f"the variable `{match[0]:.60}` is not defined"
            self._report.add(codes.INCOMPLETE_ELEMENT, span, message)
            return match[0]
        if match[1] is None:
            message = f"`{match[0]}` was replaced by its value now, `{known[name]:.100}`"
            self._report.add(codes.SETTING_DROPPED, span, message)
        return known[name]

    def _author(self, element: Element) -> str:
        name, address = self._text(element), attribute(element, "email")
        return f"{name} <{address}>" if name and address else name or address

    def _dependencies(self, parent: Element) -> Iterator[PortDependency]:
        for element in parent.children:
            port = self._text(element)
            if name_of(element) != "port":
                self._unknown(element)
            elif port:
                timeout = self._seconds(attribute(element, "timeout"), element)
                request = attribute(element, "request")
                yield PortDependency(port, timeout, request, element.tag.span)

    def _seconds(self, text: str, element: Element) -> float:
        try:
            seconds = float(text or 0)
        except ValueError:
            seconds = -1.0
        if 0 <= seconds <= 86400:
            return seconds
        message = f"`{text:.40}` is no number of seconds"
        self._report.add(codes.INCOMPLETE_ELEMENT, element.tag.span, message)
        return 0.0

    def _module(self, element: Element) -> ModuleEntry | None:
        span = element.tag.span
        texts = {name_of(each): self._text(each) for each in reversed(element.children)}
        if not texts.get("name"):
            self._report.add(codes.INCOMPLETE_ELEMENT, span, "a module without `<name>`")
            return None
        for each in element.children:
            if name_of(each) not in _KNOWN_OF_MODULE:
                self._unknown(each)
        waits = [
            (attribute(wait, "when"), self._seconds(self._text(wait), wait))
            for ensure in children(element, "ensure")
            for wait in children(ensure, "wait")
        ]
        return ModuleEntry(
            texts["name"],
            span,
            **{name: texts.get(name, "") for name in _TEXTS},
            deployer=texts.get("deployer") or texts.get("broker", ""),
            wait_s=max((seconds for when, seconds in waits if when != "stop"), default=0.0),
            stop_wait_s=max((seconds for when, seconds in waits if when == "stop"), default=0.0),
            dependencies=tuple(
                dependency
                for dependencies in children(element, "dependencies")
                for dependency in self._dependencies(dependencies)
            ),
            portmaps=tuple(
                (self._text(child(each, "old")), self._text(child(each, "new")))
                for each in children(element, "portmap")
            ),
        )

    def _connection(self, element: Element) -> ConnectionEntry | None:
        source, target = child(element, "from", "output"), child(element, "to", "input")
        for each in element.children:
            if name_of(each) not in _KNOWN_OF_CONNECTION:
                self._unknown(each)
        ends = self._text(source), self._text(target)
        if source is None or target is None or not all(ends):
            message = "a connection needs `<from>` and `<to>`"
            self._report.add(codes.INCOMPLETE_ELEMENT, element.tag.span, message)
            return None
        qos = [attribute(each, "qos") for each in (element, source, target)]
        return ConnectionEntry(
            *ends,
            self._text(child(element, "protocol")),
            element.tag.span,
            source_external=attribute(source, "external").lower() == "true",
            target_external=attribute(target, "external").lower() == "true",
            persistent=attribute(element, "persist").lower() == "true",
            qos=next(filter(None, qos), ""),
        )

    def _nested(self, element: Element) -> NestedApplication | None:
        name = self._text(child(element, "name"))
        if name:
            return NestedApplication(name, self._text(child(element, "prefix")), element.tag.span)
        self._report.add(
            codes.INCOMPLETE_ELEMENT, element.tag.span, "a nested application without `<name>`"
        )
        return None
