"""The deployments of old: rcmanager's XML, and the TOML of its successor `sub.toml`.

In: the file. Out: one `Node` for each process, and findings about what could not be understood.
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
from robocomp_dsl.migrate.ice import Address, address
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax import parse_innermodel
from robocomp_dsl.syntax.ast_innermodel import Element

BROKERS = ("rcnode", "icebox", "icestorm")
REMOTE = ("rcremote",)
NO_CONFIG = ("", "xxx")
"""What people wrote where there is no configuration."""

_SSH = re.compile(r"\bssh\s+(?:-\S+\s+)*([A-Za-z_][\w-]*)@(\S+)")
_CONFIG_OPTION = "--Ice.Config="


@dataclass(frozen=True, slots=True)
class Node:
    """One process. `folder` is where its component was, `config` its configuration there."""

    name: str
    address: Address | None
    host: str
    user: str
    folder: PurePosixPath
    command: str
    config: PurePosixPath | None
    after: tuple[tuple[str, Span], ...]
    span: Span


def read_manager(source: Source, report: Report) -> list[Node] | None:
    """The processes of a file; None for one that is nothing of the kind, which is told."""
    if source.path.suffix.lower() == ".toml":
        return _read_toml(source, report)
    tree = parse_innermodel(source, report)
    if tree.root is None or tree.root.tag.text.lower() != "rcmanager":
        called = f"its root is `<{tree.root.tag.text:.40}>`" if tree.root else "it has no elements"
        said = f"`{source.path.name}` is no file of rcmanager: {called}"
        report.add(codes.UNREADABLE_FILE, source.whole, said)
        return None
    return _unique(_xml_nodes(tree.root, report), source, report)


def _unique(nodes: Iterator[Node], source: Source, report: Report) -> list[Node]:
    """One entry of each name, without the brokers and what depends on them."""
    seen: dict[str, Node] = {}
    brokers = set()
    kept = []
    for one in nodes:
        if one.name in seen:
            report.add(codes.NODE_INCOMPLETE, one.span, f"there are two entries `{one.name}`")
            continue
        seen[one.name] = one
        words = f"{one.address.identity if one.address else ''} {one.command}".lower()
        if any(re.search(rf"\b{broker}\b", words) for broker in BROKERS):
            report.add(codes.NODE_DROPPED, one.span, f"`{one.name}` is not needed any more")
            brokers.add(one.name)
        else:
            kept.append(one)
    if not seen:
        report.add(codes.UNREADABLE_FILE, source.whole, f"`{source.path.name}` has no entries")
    return [replace(k, after=tuple(a for a in k.after if a[0] not in brokers)) for k in kept]


def _xml_nodes(root: Element, report: Report) -> Iterator[Node]:
    for one in root.children:
        if one.tag.text.lower() != "node":
            continue
        name = _attribute(one, "alias")
        begin = one.tag.span
        if not name:
            report.add(codes.NODE_INCOMPLETE, begin, "an entry without `alias`")
            continue
        below = {child.tag.text.lower(): child for child in one.children}
        command = _attribute(below.get("upcommand"), "command")
        after = tuple(
            (_attribute(child, "alias"), child.span)
            for child in one.children
            if child.tag.text.lower() == "dependence" and _attribute(child, "alias")
        )
        yield _node(
            name,
            _attribute(one, "endpoint"),
            command,
            _attribute(below.get("workingdir"), "path"),
            _attribute(below.get("configfile"), "path"),
            _attribute(below.get("downcommand"), "command"),
            after,
            begin,
        )


def _attribute(one: Element | None, name: str) -> str:
    found = one.get(name) if one else None
    return found.value.value.strip() if found else ""


def _read_toml(source: Source, report: Report) -> list[Node] | None:
    try:
        entries = tomllib.loads(source.text.replace("\r\n", "\n")).get("components")
    except (tomllib.TOMLDecodeError, RecursionError, ValueError) as error:
        said = f"`{source.path.name}` is no TOML: {error}"
        report.add(codes.UNREADABLE_FILE, source.whole, said)
        return None
    if not isinstance(entries, list):
        said = f"`{source.path.name}` has no `[[components]]`"
        report.add(codes.UNREADABLE_FILE, source.whole, said)
        return None
    return _unique(_toml_nodes(entries, source, report), source, report)


def _toml_nodes(entries: list[object], source: Source, report: Report) -> Iterator[Node]:
    heads = [m.span() for m in re.finditer(r"(?m)^[ \t]*\[\[components\]\]", source.text)]
    for number, one in enumerate(entries):
        span = source.span(*heads[number]) if number < len(heads) else source.whole
        name = one.get("name") if isinstance(one, dict) else None
        if not isinstance(one, dict) or not isinstance(name, str) or not name.strip():
            report.add(codes.NODE_INCOMPLETE, span, "an entry without `name`")
            continue
        said = {key: str(one.get(key, "")) for key in ("ice_name", "cmd", "cwd")}
        yield _node(name.strip(), said["ice_name"], said["cmd"], said["cwd"], "", "", (), span)


def _node(
    name: str,
    endpoint: str,
    command: str,
    folder: str,
    config: str,
    down: str,
    after: tuple[tuple[str, Span], ...],
    span: Span,
) -> Node:
    words = _words(command)
    host = ""
    if words and PurePosixPath(words[0]).name in REMOTE and len(words) > 3:
        host, folder, words = words[1], words[3], words[4:]
    where = address("", endpoint, span)
    ssh = _SSH.search(down)
    named = _config_in(words) or _words(config)[-1:] or [""]
    return Node(
        name,
        where,
        host or (where.host if where else ""),
        ssh[1] if ssh else "",
        PurePosixPath(folder),
        command,
        PurePosixPath(named[0]) if named[0] not in NO_CONFIG else None,
        after,
        span,
    )


def _words(command: str) -> list[str]:
    try:
        return shlex.split(command)
    except ValueError:
        return command.split()


def _config_in(words: list[str]) -> list[str]:
    """The configuration that a command names: `--Ice.Config=x`, or the last word behind others."""
    named = [w.removeprefix(_CONFIG_OPTION) for w in words if w.startswith(_CONFIG_OPTION)]
    plain = [w for w in words[1:] if "/" in w and not w.startswith("-") and not w.endswith(".py")]
    return named[:1] or plain[-1:]
