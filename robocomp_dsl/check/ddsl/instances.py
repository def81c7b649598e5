"""Resolves one component instance of a deployment: its component, host and settings.

In: an instance and the imported components. Out: an `Instance`, and diagnostics.
"""

from __future__ import annotations

import os
import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path

from robocomp_dsl.check.cdsl.middlewares import find_middleware
from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.ddsl.contexts import config_search_of
from robocomp_dsl.check.ddsl.copied_files import copied_files
from robocomp_dsl.check.ddsl.definitions import DefinitionFiles
from robocomp_dsl.check.ddsl.devices import resolve_devices
from robocomp_dsl.check.ddsl.own_ports import own_ports_of
from robocomp_dsl.check.ddsl.places import DEFAULT_PLACE, InstancePlace
from robocomp_dsl.check.ddsl.prefixes import prefix_of
from robocomp_dsl.check.ddsl.programs import program_component
from robocomp_dsl.check.ddsl.readiness import limits_of, port_of, readiness_of
from robocomp_dsl.check.ddsl.restarts import ready_of, restart_of
from robocomp_dsl.check.ddsl.setting_paths import PathSearch
from robocomp_dsl.check.ddsl.settings import settings_of
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.duplicates import unique_by_name
from robocomp_dsl.check.watchdog import watchdog_of
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.check.workspace.referenced_files import find_referenced_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import UNPLACED, Instance
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name, Text

DEFAULT_EXECUTABLE = "python3 main.py"
_CONFIGURATIONS = (".yaml", ".yml", ".toml", "")
"""RoboComp's own configurations are named `config`, without a suffix."""


class InstanceContext(ValueRecord):
    """The context for resolving an instance.

    `places` are those of the instances by qualified name.
    """

    definitions: DefinitionFiles
    places: Mapping[str, InstancePlace]
    workspace: Workspace


def resolve_instance(
    tree: ast.Instance, group: str, around: InstanceContext, report: Report
) -> Instance | None:
    """Resolve the instance of `tree`; None if its component is unknown."""
    component = (
        program_component(tree, tree.span.source.path, report)
        if tree.is_program
        else _component(tree.component or tree.name, around, report)
    )
    place = around.places.get(tree.name.text, DEFAULT_PLACE)
    files = copied_files(tree.files, tree.span.source.path, report)
    config = _config(tree.config, around, report)
    context, searched = config_search_of(tree, report)
    prefix = prefix_of(tree.prefix, report)
    executable = _executable(tree.executable, report)
    port = port_of(tree.port, report, "without `port` a free port is used")
    restart, ready = restart_of(tree.restart, report), ready_of(tree.ready, report)
    readiness, limits = readiness_of(tree.ready_when, report), limits_of(tree, report)
    watchdog = watchdog_of(tree.watchdog, codes.DEPLOYMENT_NUMBER, report)
    environment = unique_by_name(tree.environment, "environment variable", report)
    devices = resolve_devices(tree, report)
    middleware = find_middleware(tree.middleware, around.workspace.middlewares, report)
    if component is None:
        return None
    search = PathSearch(component.path.parent, config, place.host.is_local)
    written = () if tree.is_program else tree.settings
    settings, paths = settings_of(written, component, search, report)
    return Instance(
        name=tree.name.text,
        component=component,
        span=tree.name.span,
        host=place.host,
        config=config,
        context=context,
        config_name=searched,
        prefix=prefix,
        settings=settings,
        setting_paths=paths,
        devices=devices,
        environment=tuple((node.name.text, node.value.value) for node in environment),
        executable=executable,
        port=port,
        after=tuple(dict.fromkeys(node.text for node in tree.after)),
        restart=restart,
        start_timeout_s=ready,
        readiness=readiness,
        limits=limits,
        watchdog_s=watchdog,
        middleware=middleware,
        own_ports=own_ports_of(tree.own_ports, component, around.workspace.middlewares, report),
        doc=tree.doc,
        group=group,
        host_span=place.span,
        is_program=tree.is_program,
        placement=place.placement,
        files=files,
    )


def report_shared_ports(
    trees: Sequence[ast.Instance], places: Mapping[str, InstancePlace], report: Report
) -> None:
    """Report two instances that would listen on the same port of the same machine."""
    first: dict[tuple[str, float], ast.Instance] = {}
    for tree in trees:
        if tree.port is None or not tree.port.value:
            continue
        host = places.get(tree.name.text, DEFAULT_PLACE).host
        if host is UNPLACED:
            continue
        key = (host.machine, tree.port.value)
        earlier = first.setdefault(key, tree)
        if earlier is not tree and earlier.port is not None:
            report.add(
                codes.SHARED_PORT,
                tree.port.span,
                f"`{tree.name.text}` and `{earlier.name.text}` both use port {tree.port.span.text}",
                notes=[Note(earlier.port.span, "already used here")],
                help="remove `port`: components discover each other without it",
            )


def _component(name: Name, context: InstanceContext, report: Report) -> Component | None:
    imported = context.definitions.components_of(name)
    known = imported.components
    if name.text in known:
        return known[name.text]
    by_file = next((node for node in known.values() if node.path.stem == name.text), None)
    guess = by_file.name if by_file else nearest(name.text, known)
    if imported.broken and guess is None:
        return None
    report.add(
        codes.UNKNOWN_COMPONENT,
        name.span,
        f"component `{name.text}` is not declared by any import",
        label=f"did you mean `{guess}`?" if guess else "",
        notes=[Note(known[guess].span, f"`{guess}` is declared here")] if guess else [],
        help=f"the imports declare {join_names(list(known))}"
        if known
        else 'import its CDSL file: `import "../components/arm/arm.cdsl";`',
        fix=replace_fix(name.span, guess) if guess else None,
    )
    return None


def _config(written: Text | None, context: InstanceContext, report: Report) -> Path | None:
    """The absolute path of a configuration file: components run in other folders."""
    if written is None:
        return None
    beside = written.span.source.path
    path = find_referenced_file(written, _CONFIGURATIONS, beside, context.workspace, report)
    return Path(os.path.abspath(path)) if path else None  # noqa: PTH100 - keeps symbolic links


def _executable(written: Text | None, report: Report) -> str:
    if written is None:
        return DEFAULT_EXECUTABLE
    try:
        words = shlex.split(written.value)
        problem = "" if words else "it is empty"
    except ValueError as error:
        problem = str(error)[:1].lower() + str(error)[1:]
    if problem:
        what = f"invalid command line in `executable`: {problem}"
        report.add(codes.COMMAND_LINE, written.span, what, help="for example `python3 main.py`")
        return DEFAULT_EXECUTABLE
    return written.value
