"""Read old deployments: rcmanager's XML, and the TOML of its successor `sub.toml`.

In: the file. Out: one `ManagerNode` for each process, and findings about invalid entries.
"""

from __future__ import annotations

import re
import shlex
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import PurePosixPath

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.ice import Address, parse_address
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast.innermodel import Element
from robocomp_dsl.syntax.parse import parse_innermodel

BROKERS = ("rcnode", "icebox", "icestorm")
REMOTE = ("rcremote",)
NO_CONFIG = ("", "xxx")
"""Values that stand for no configuration."""

_SSH = re.compile(r"\bssh\s+(?:-\S+\s+)*([A-Za-z_][\w-]*)@(\S+)")
_CONFIG_OPTION = "--Ice.Config="


@dataclass(frozen=True, slots=True)
class ManagerNode:
    """One process. `folder` is its component's folder, `config` a configuration in it."""

    name: str
    address: Address | None
    host: str
    user: str
    folder: PurePosixPath
    command: str
    config: PurePosixPath | None
    after: tuple[tuple[str, Span], ...]
    span: Span


def read_manager(source: Source, report: Report) -> list[ManagerNode] | None:
    """The processes of a file; None, with a finding, for a file of another kind."""
    if source.path.suffix.lower() == ".toml":
        return _read_toml(source, report)
    tree = parse_innermodel(source, report)
    if tree.root is None or tree.root.tag.text.lower() != "rcmanager":
        problem = f"its root is `<{tree.root.tag.text:.40}>`" if tree.root else "it has no elements"
        message = f"`{source.path.name}` is not a file of rcmanager: {problem}"
        report.add(codes.UNREADABLE_FILE, source.file_span, message)
        return None
    return _unique(_xml_nodes(tree.root, report), source, report)


def _unique(nodes: Iterator[ManagerNode], source: Source, report: Report) -> list[ManagerNode]:
    """The first entry of each name, without brokers and dependencies on them."""
    seen: dict[str, ManagerNode] = {}
    brokers = set()
    remaining = []
    for node in nodes:
        if node.name in seen:
            report.add(codes.NODE_INCOMPLETE, node.span, f"there are two entries `{node.name}`")
            continue
        seen[node.name] = node
        words = f"{node.address.identity if node.address else ''} {node.command}".lower()
        if any(re.search(rf"\b{broker}\b", words) for broker in BROKERS):
            report.add(codes.NODE_DROPPED, node.span, f"`{node.name}` is no longer needed")
            brokers.add(node.name)
        else:
            remaining.append(node)
    if not seen:
        report.add(codes.UNREADABLE_FILE, source.file_span, f"`{source.path.name}` has no entries")
    return [replace(k, after=tuple(a for a in k.after if a[0] not in brokers)) for k in remaining]


def _xml_nodes(root: Element, report: Report) -> Iterator[ManagerNode]:
    for element in root.children:
        if element.tag.text.lower() != "node":
            continue
        name = _attribute(element, "alias")
        span = element.tag.span
        if not name:
            report.add(codes.NODE_INCOMPLETE, span, "an entry without `alias`")
            continue
        below = {child.tag.text.lower(): child for child in element.children}
        command = _attribute(below.get("upcommand"), "command")
        after = tuple(
            (_attribute(child, "alias"), child.span)
            for child in element.children
            if child.tag.text.lower() == "dependence" and _attribute(child, "alias")
        )
        yield _node(
            name,
            _attribute(element, "endpoint"),
            command,
            _attribute(below.get("workingdir"), "path"),
            _attribute(below.get("configfile"), "path"),
            _attribute(below.get("downcommand"), "command"),
            after,
            span,
        )


def _attribute(element: Element | None, name: str) -> str:
    attribute = element.get(name) if element else None
    return attribute.value.value.strip() if attribute else ""


def _read_toml(source: Source, report: Report) -> list[ManagerNode] | None:
    try:
        entries = tomllib.loads(source.text.replace("\r\n", "\n")).get("components")
    except (tomllib.TOMLDecodeError, RecursionError, ValueError) as error:
        message = f"`{source.path.name}` is not TOML: {error}"
        report.add(codes.UNREADABLE_FILE, source.file_span, message)
        return None
    if not isinstance(entries, list):
        message = f"`{source.path.name}` has no `[[components]]`"
        report.add(codes.UNREADABLE_FILE, source.file_span, message)
        return None
    return _unique(_toml_nodes(entries, source, report), source, report)


def _toml_nodes(entries: list[object], source: Source, report: Report) -> Iterator[ManagerNode]:
    heads = [m.span() for m in re.finditer(r"(?m)^[ \t]*\[\[components\]\]", source.text)]
    for number, entry in enumerate(entries):
        span = source.span(*heads[number]) if number < len(heads) else source.file_span
        name = entry.get("name") if isinstance(entry, dict) else None
        if not isinstance(entry, dict) or not isinstance(name, str) or not name.strip():
            report.add(codes.NODE_INCOMPLETE, span, "an entry without `name`")
            continue
        values = {key: str(entry.get(key, "")) for key in ("ice_name", "cmd", "cwd")}
        yield _node(
            name.strip(), values["ice_name"], values["cmd"], values["cwd"], "", "", (), span
        )


def _node(
    name: str,
    endpoint: str,
    command: str,
    folder: str,
    config: str,
    down: str,
    after: tuple[tuple[str, Span], ...],
    span: Span,
) -> ManagerNode:
    words = _split_command(command)
    host = ""
    if words and PurePosixPath(words[0]).name in REMOTE and len(words) > 3:
        host, folder, words = words[1], words[3], words[4:]
    address = parse_address("", endpoint, span)
    ssh = _SSH.search(down)
    config_names = _config_in(words) or _split_command(config)[-1:] or [""]
    return ManagerNode(
        name,
        address,
        host or (address.host if address else ""),
        ssh[1] if ssh else "",
        PurePosixPath(folder),
        command,
        PurePosixPath(config_names[0]) if config_names[0] not in NO_CONFIG else None,
        after,
        span,
    )


def _split_command(command: str) -> list[str]:
    try:
        return shlex.split(command)
    except ValueError:
        return command.split()


def _config_in(words: list[str]) -> list[str]:
    """The configuration in a command: `--Ice.Config=x`, or else the last path argument."""
    named = [w.removeprefix(_CONFIG_OPTION) for w in words if w.startswith(_CONFIG_OPTION)]
    plain = [w for w in words[1:] if "/" in w and not w.startswith("-") and not w.endswith(".py")]
    return named[:1] or plain[-1:]
