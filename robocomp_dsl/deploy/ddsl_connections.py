"""Writes a change of a running connection into a DDSL file; all other characters stay.

In: a file, the two ports of a connection by full names. Out: the new text of the file. An edit is
verified: the checks find no new error, and the connections of the deployment differ in exactly this
one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy.ddsl_qos import changed_qos, format_statements
from robocomp_dsl.deploy.ddsl_settings import CannotEdit
from robocomp_dsl.deploy.write_text import FileNotReplaced, write_text
from robocomp_dsl.diagnostics import Report, Severity
from robocomp_dsl.model.deployment import Connection, Deployment
from robocomp_dsl.source import Source, UnreadableSource
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.languages.ddsl import parse

_INDENT = "    "
Scope = ast.Deployment | ast.Group


@dataclass(frozen=True, slots=True)
class ConnectionNames:
    """The ports of a connection, with full names of components, as `connect` orders them."""

    source: str
    source_port: str
    target: str
    target_port: str

    def __str__(self) -> str:
        return f"{self.source}.{self.source_port} -> {self.target}.{self.target_port}"


def write_connection(path: Path, names: ConnectionNames, middleware: str = "") -> None:
    """Add a `connect`, or give an existing one the middleware. Raises `CannotEdit`."""
    editor = _Editor(path)
    over = f" over {middleware}" if middleware else ""
    known = editor.find(names)
    if known is None or known.implied:
        text = editor.with_statement(names, f"{over};")
    elif middleware in ("", known.middleware):
        return
    else:
        text = editor.with_middleware(known, middleware)
    editor.write(text, names, present=True)


def remove_connection(path: Path, names: ConnectionNames) -> None:
    """Remove the `connect` of two ports. Raises `CannotEdit`."""
    editor = _Editor(path)
    known = editor.find(names)
    if known is None:
        raise CannotEdit(f"{path.name} has no connection {names}")
    editor.write(editor.without(known), names, present=False)


def write_connection_qos(path: Path, names: ConnectionNames, items: Sequence[str]) -> None:
    """Change the quality of service of a connection; `items` as of `rcdeploy qos`.

    Raises `CannotEdit`.
    """
    editor = _Editor(path)
    known = editor.find(names)
    if known is None:
        raise CannotEdit(f"{path.name} has no connection {names}")
    statements = format_statements(changed_qos(known.qos, items))
    if known.implied:
        text = editor.with_statement(names, f" {{ {statements} }};" if statements else ";")
    else:
        text = editor.with_block(known, statements)
    editor.write(text, names, present=True)


class _Editor:
    """One file, with the deployment in it."""

    def __init__(self, path: Path) -> None:
        self._path = path.resolve()  # a link stays a link
        try:
            self._text = Source.read(self._path).text
        except UnreadableSource as error:
            raise CannotEdit(f"{path}: {error}") from None
        self._deployment = self._check(self._text, "has errors")
        file = parse(Source(self._path, self._text), Report())
        self._scopes: dict[int, tuple[Scope, ...]] = {}
        if file.deployment is not None:
            self._scopes = dict(_instance_scopes(file.deployment, ()))

    def find(self, names: ConnectionNames) -> Connection | None:
        """The connection in the file, written or implied."""
        return next((c for c in self._deployment.connections if _names_of(c) == names), None)

    def with_statement(self, names: ConnectionNames, end: str) -> str:
        """The text with a `connect` in the innermost scope that contains both components."""
        source, target = self._place(names.source), self._place(names.target)
        depth = _common_depth(source.scopes, target.scopes)
        first = _reference(source, depth, names.source_port)
        second = _reference(target, depth, names.target_port)
        return self._insert(source.scopes[depth - 1], f"connect {first} -> {second}{end}")

    def with_middleware(self, connection: Connection, middleware: str) -> str:
        """The text with another `over`."""
        tree = self._tree(connection)
        if tree.over is not None:
            start, end = tree.over.span.start, tree.over.span.end
            return f"{self._text[:start]}{middleware}{self._text[end:]}"
        end = tree.target.span.end
        return f"{self._text[:end]} over {middleware}{self._text[end:]}"

    def with_block(self, connection: Connection, statements: str) -> str:
        """The text with other statements in the braces; monitors stay."""
        tree = self._tree(connection)
        head = tree.over.span.end if tree.over else tree.target.span.end
        rest = self._text[head : tree.span.end]
        if "//" in rest or "/*" in rest or "#" in rest:
            raise CannotEdit(
                f"{self._path.name}: the `connect` has comments; write the items into it yourself"
            )
        monitors = " ".join(monitor.span.text for monitor in tree.monitors)
        items = " ".join(filter(None, (statements, monitors)))
        block = f" {{ {items} }};" if items else ";"
        return f"{self._text[:head]}{block}{self._text[tree.span.end :]}"

    def without(self, connection: Connection) -> str:
        """The text without a `connect`, and without its line if nothing else is in it."""
        tree = self._tree(connection)
        start, end = tree.span.start, tree.span.end
        line_start = self._text.rfind("\n", 0, start) + 1
        line_end = self._text.find("\n", end) + 1 or len(self._text)
        before, after = self._text[line_start:start], self._text[end:line_end]
        if not before.strip() and not after.strip():
            start, end = line_start, line_end
        return self._text[:start] + self._text[end:]

    def write(self, text: str, names: ConnectionNames, *, present: bool) -> None:
        """Write the new text, which has the connection or not. Raises `CannotEdit`."""
        # A port that is connected by a statement has no implied connections any more.
        before = {
            _names_of(c)
            for c in self._deployment.connections
            if not (c.implied and _searching_end(_names_of(c), c) == _searching_end(names, c))
        } - {names}
        found = {_names_of(c) for c in self._check(text, "would have errors").connections}
        if (names in found) is not present:
            raise CannotEdit(
                f"{names} follows from the requirement, so {self._path.name} has no `connect` to"
                " remove; connect the port to another component there"
                if not present
                else f"write `connect {names};` into {self._path.name} yourself"
            )
        if before - found:
            lost = ", ".join(map(str, sorted(before - found, key=str)))
            raise CannotEdit(f"{self._path.name} is unchanged: {lost} would be lost")
        try:
            write_text(self._path, text)
        except FileNotReplaced as error:
            raise CannotEdit(str(error)) from None

    def _check(self, text: str, problem: str) -> Deployment:
        report = Report()
        workspace = Workspace()
        workspace.sources.set_overlay(self._path, text)
        deployment = check_ddsl(self._path, workspace, report)
        errors = [f for f in report.sorted() if f.severity is Severity.ERROR]
        if deployment is None or errors:
            reason = f": {errors[0].message}" if errors else ""
            raise CannotEdit(f"{self._path.name} {problem}{reason}")
        return deployment

    def _tree(self, connection: Connection) -> ast.Connection:
        """The statement of a connection. Raises `CannotEdit` if it belongs to several."""
        same = [c for c in self._deployment.connections if c.span.start == connection.span.start]
        scopes = {id(scope): scope for chain in self._scopes.values() for scope in chain}
        trees = [tree for scope in scopes.values() for tree in scope.connections]
        tree = next((t for t in trees if t.span.start == connection.span.start), None)
        if connection.implied or tree is None or len(same) > 1:
            raise CannotEdit(
                f"{_names_of(connection)} has no `connect` of its own in {self._path.name}; change"
                " it there yourself"
            )
        return tree

    def _place(self, full_name: str) -> _InstancePlace:
        instances = self._deployment.instances
        instance = next((i for i in instances if i.full_name == full_name), None)
        if instance is None:
            raise CannotEdit(f"{self._path.name} has no component `{full_name}`")
        start = instance.span.start
        same = [other for other in instances if other.span.start == start]
        if start not in self._scopes or len(same) > 1:
            raise CannotEdit(
                f"`{full_name}` is declared in the definition of a group; write the connection into"
                f" {self._path.name} yourself"
            )
        return _InstancePlace(instance.span.text, full_name, self._scopes[start])

    def _insert(self, scope: Scope, statement: str) -> str:
        """The text with a statement after the last connection of a scope, or its last item."""
        connections = [connection.span for connection in scope.connections]
        others = [item.span for item in (*scope.instances, *scope.groups)]
        last = max(connections or others, key=lambda span: span.end)
        newline = "\r\n" if "\r\n" in self._text else "\n"
        line = self._text[self._text.rfind("\n", 0, last.start) + 1 : last.start]
        indent = re.match(r"[ \t]*", line)
        separator = f"{newline}{indent[0] if indent else _INDENT}" if not line.strip() else " "
        return f"{self._text[: last.end]}{separator}{statement}{self._text[last.end :]}"


@dataclass(frozen=True, slots=True)
class _InstancePlace:
    """An instance, and the scopes around it, the deployment first."""

    name: str
    full_name: str
    scopes: tuple[Scope, ...]


def _instance_scopes(
    scope: Scope, around: tuple[Scope, ...]
) -> Iterator[tuple[int, tuple[Scope, ...]]]:
    """The offsets of the names of instances, with the scopes around each."""
    chain = (*around, scope)
    for instance in scope.instances:
        yield instance.name.span.start, chain
    for group in scope.groups:
        yield from _instance_scopes(group, chain)


def _common_depth(first: Sequence[Scope], second: Sequence[Scope]) -> int:
    depth = 0
    while depth < min(len(first), len(second)) and first[depth] is second[depth]:
        depth += 1
    return depth


def _reference(place: _InstancePlace, depth: int, port: str) -> str:
    """How a port is written in the scope at `depth`: through exports, if it is in a group."""
    name = place.name
    for group in reversed(place.scopes[depth:]):
        assert isinstance(group, ast.Group)  # noqa: S101 - only the first scope is the deployment
        exports: Mapping[tuple[str, str], str] = {
            (e.target.instance.text, e.target.port.text): e.port.text for e in group.exports
        }
        public = exports.get((name, port))
        if public is None:
            raise CannotEdit(
                f"the group `{group.name.text}` does not export `{port}` of `{place.full_name}`;"
                f" write `export {port} from {name};` into it first"
            )
        name, port = group.name.text, public
    return f"{name}.{port}"


def _searching_end(names: ConnectionNames, connection: Connection) -> tuple[str, str]:
    """The end that looks for the other, of a connection of the kind of `connection`."""
    if connection.source_port.role.is_topic:
        return names.target, names.target_port
    return names.source, names.source_port


def _names_of(connection: Connection) -> ConnectionNames:
    return ConnectionNames(
        connection.source.full_name,
        connection.source_port.name,
        connection.target.full_name,
        connection.target_port.name,
    )
