"""The components of a deployment, one by one: what runs, where, and with what.

In: an instance as written and the imported components. Out: an `Instance`, and findings.
"""

from __future__ import annotations

import os
import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path

from robocomp_dsl.check import codes
from robocomp_dsl.check.components import Imported
from robocomp_dsl.check.contexts import searched_of
from robocomp_dsl.check.devices import devices_of
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.named_files import find_beside
from robocomp_dsl.check.names import without_repeats
from robocomp_dsl.check.prefixes import prefix_of
from robocomp_dsl.check.restarts import ready_of, restart_of
from robocomp_dsl.check.settings import settings_of
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import THIS_MACHINE, Host, Instance
from robocomp_dsl.record import Value
from robocomp_dsl.syntax import ast_ddsl as ast
from robocomp_dsl.syntax.ast_base import Name, Number, Text

HERE = Host("", "127.0.0.1")
_LOCAL = Host(THIS_MACHINE, THIS_MACHINE)
DEFAULT_EXECUTABLE = "python3 main.py"
_CONFIGURATIONS = (".yaml", ".yml", ".toml")
_LAST_PORT = 65535


class Surroundings(Value):
    """What an instance may refer to. `path` is that of the DDSL file."""

    path: Path
    imported: Imported
    hosts: Mapping[str, Host]
    workspace: Workspace


def instance_of(
    tree: ast.Instance, group: str, around: Surroundings, report: Report
) -> Instance | None:
    """The instance that `tree` describes; None when its component is not known."""
    component = _component(tree.component or tree.name, around, report)
    host = _host(tree.host, around, report)
    config = _config(tree.config, around, report)
    context, searched = searched_of(tree, report)
    prefix = prefix_of(tree.prefix, report)
    executable = _executable(tree.executable, report)
    port = _port(tree.port, report)
    restart, ready = restart_of(tree.restart, report), ready_of(tree.ready, report)
    environment = without_repeats(tree.environment, "environment variable", report)
    devices = devices_of(tree, report)
    if component is None:
        return None
    return Instance(
        name=tree.name.text,
        component=component,
        span=tree.name.span,
        host=host,
        config=config,
        context=context,
        searched=searched,
        prefix=prefix,
        settings=settings_of(tree.settings, component, report),
        devices=devices,
        environment=tuple((one.name.text, one.value.value) for one in environment),
        executable=executable,
        port=port,
        after=tuple(dict.fromkeys(one.text for one in tree.after)),
        restart=restart,
        ready_within_s=ready,
        doc=tree.doc,
        group=group,
        placed=tree.host.span if tree.host else None,
    )


def report_shared_ports(trees: Sequence[ast.Instance], report: Report) -> None:
    """Report two instances that would listen on the same port of the same machine."""
    first: dict[tuple[str, float], ast.Instance] = {}
    for tree in trees:
        if tree.port is None or not tree.port.value:
            continue
        key = (tree.host.text if tree.host else "", tree.port.value)
        earlier = first.setdefault(key, tree)
        if earlier is not tree and earlier.port is not None:
            report.add(
                codes.SHARED_PORT,
                tree.port.span,
                f"`{tree.name.text}` and `{earlier.name.text}` both use port {tree.port.span.text}",
                notes=[Note(earlier.port.span, "it is already used here")],
                help="leave the port out: the components find each other without it",
            )


def _component(name: Name, around: Surroundings, report: Report) -> Component | None:
    known = around.imported.components
    if name.text in known:
        return known[name.text]
    by_file = next((one for one in known.values() if one.path.stem == name.text), None)
    guess = by_file.name if by_file else nearest(name.text, known)
    if around.imported.broken and guess is None:
        return None
    report.add(
        codes.UNKNOWN_COMPONENT,
        name.span,
        f"component `{name.text}` is not declared by any import",
        label=f"did you mean `{guess}`?" if guess else "",
        notes=[Note(known[guess].span, f"`{guess}` is declared here")] if guess else [],
        help=f"the imports declare {listing(list(known))}"
        if known
        else 'import its CDSL file: `import "../components/arm/arm.cdsl";`',
        fix=replace(name.span, guess) if guess else None,
    )
    return None


def _host(name: Name | None, around: Surroundings, report: Report) -> Host:
    if name is None:
        return HERE
    if name.text in around.hosts:
        return around.hosts[name.text]
    if name.text == THIS_MACHINE:
        return _LOCAL
    guess = nearest(name.text, around.hosts)
    report.add(
        codes.UNKNOWN_HOST,
        name.span,
        f"there is no host `{name.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help="" if guess else f'declare it: `host {name.text} {{ address "10.0.0.2"; }};`',
        fix=replace(name.span, guess) if guess else None,
    )
    return HERE


def _config(written: Text | None, around: Surroundings, report: Report) -> Path | None:
    """The absolute path of a configuration file: components run in other folders."""
    if written is None:
        return None
    path = find_beside(written, _CONFIGURATIONS, around.path, around.workspace, report)
    return Path(os.path.abspath(path)) if path else None  # noqa: PTH100 - symbolic links stay


def _executable(written: Text | None, report: Report) -> str:
    if written is None:
        return DEFAULT_EXECUTABLE
    try:
        words = shlex.split(written.value)
        problem = "" if words else "it is empty"
    except ValueError as error:
        problem = str(error)[:1].lower() + str(error)[1:]
    if problem:
        what = f"`executable` is not a command line: {problem}"
        report.add(codes.COMMAND_LINE, written.span, what, help="such as `python3 main.py`")
        return DEFAULT_EXECUTABLE
    return written.value


def _port(written: Number | None, report: Report) -> int:
    if written is None:
        return 0
    if isinstance(written.value, int) and 1 <= written.value <= _LAST_PORT:
        return written.value
    report.add(
        codes.PORT_NUMBER,
        written.span,
        f"a port is a whole number from 1 to {_LAST_PORT}, not `{written.span.text}`",
        help="leave it out and a free port is used",
    )
    return 0
