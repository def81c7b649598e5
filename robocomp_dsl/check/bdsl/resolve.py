"""Resolves the bridge of a BDSL file.

In: the tree and a workspace. Out: a `Bridge` of all valid parts, the diagnostics of this file, and
the errors of the files that it imports.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TypeAlias

from robocomp_dsl.check.bdsl.actions import resolve_action
from robocomp_dsl.check.bdsl.addresses import check_addresses
from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.declarations import check_names, resolve_function, resolve_input
from robocomp_dsl.check.bdsl.hubs import HubResolver
from robocomp_dsl.check.bdsl.outputs import rate_of, resolve_output
from robocomp_dsl.check.bdsl.scopes import BridgeScope
from robocomp_dsl.check.bdsl.services import resolve_service
from robocomp_dsl.check.bdsl.types_module import TypesModule
from robocomp_dsl.check.cdsl.middlewares import DEFAULT, find_middleware
from robocomp_dsl.check.codes import bridge as codes
from robocomp_dsl.check.names.duplicates import Named
from robocomp_dsl.check.workspace.loaded import transitive_errors
from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.component import Role
from robocomp_dsl.syntax.ast import bdsl as ast

_Declaration: TypeAlias = ast.Input | ast.Function | ast.Hub | ast.Output | ast.Service


def resolve_bdsl(
    file: Parsed[ast.File], tree: ast.Bridge, workspace: Workspace, report: Report
) -> Bridge:
    """Resolve the bridge `tree` of a file."""
    links = workspace.modules.resolve_imports(file.tree.imports, report)
    report.extend(transitive_errors(links))
    scope = workspace.modules.import_scope(file, links)
    path = file.source.path
    types = TypesModule(tree.name.text, path, tree.name.span)
    context = BridgeContext(scope, types, workspace, report, is_complete=file.tree.complete)
    written = find_middleware(tree.middleware, workspace.middlewares, report)
    context.middleware = written or DEFAULT
    valid = check_names([*_named(tree), *tree.actions], context)
    context.declared = {item.name.text: item.name.span for item in _all_named(tree)}
    for ports in (tree.inputs, tree.outputs, tree.services):
        context.port_names.update(port.name.text.lower() for port in ports)
    _declare(tree, valid, context)
    hubs = HubResolver([hub for hub in tree.hubs if id(hub) in valid], context)
    resolved_hubs = hubs.resolve_all()
    names = BridgeScope(context, hubs.find, has_time=True)
    rate_hz = rate_of(tree.rate, context)
    outputs = [resolve_output(output, rate_hz, names) for output in tree.outputs]
    services = [resolve_service(service, context) for service in tree.services]
    actions = [resolve_action(action, context) for action in tree.actions]
    inputs = tuple(source for source in context.inputs.values() if source)
    modules = (*scope.direct, *context.further_modules)
    bridge = Bridge(
        name=tree.name.text,
        path=path,
        span=tree.name.span,
        modules=scope.direct,
        types=types.module(modules, f"Types and topics of the bridge {tree.name.text}."),
        inputs=inputs,
        functions=tuple(function for function in context.functions.values() if function),
        hubs=resolved_hubs,
        outputs=tuple(output for output in outputs if output),
        services=tuple(service for service in services if service),
        actions=tuple(action for action in actions if action),
        middleware=context.middleware,
        doc=tree.doc,
    )
    check_addresses(
        [source.port for source in inputs],
        [output.port for output in bridge.outputs],
        [port for port in bridge.ports if port.role is Role.IMPLEMENTS],
        context,
    )
    if context.is_complete:
        _check_content(tree, context)
    return bridge


def _named(tree: ast.Bridge) -> tuple[_Declaration, ...]:
    return (*tree.inputs, *tree.functions, *tree.hubs, *tree.outputs, *tree.services)


def _all_named(tree: ast.Bridge) -> Iterator[Named]:
    """What has a name in a bridge, also inside of services and actions."""
    yield from _named(tree)
    for service in tree.services:
        yield from service.calls
    for action in tree.actions:
        yield from action.states


def _declare(tree: ast.Bridge, valid: set[int], context: BridgeContext) -> None:
    """Resolve inputs and functions; a duplicate name keeps its first declaration."""
    for source in tree.inputs:
        if id(source) in valid:
            context.inputs[source.name.text] = resolve_input(source, context)
    for function in tree.functions:
        if id(function) in valid:
            context.functions[function.name.text] = resolve_function(function, context)


def _check_content(tree: ast.Bridge, context: BridgeContext) -> None:
    """Report a bridge that does nothing, and declarations that nothing uses."""
    if not tree.outputs and not tree.services and not tree.actions:
        context.report.add(
            codes.EMPTY_BRIDGE,
            tree.name.span,
            f"the bridge `{tree.name.text}` sends nothing",
            help="add an `output`, a `service` or an `action`",
        )
        return
    # What a faulty statement names is not called unused.
    used = context.used_names | (_mentioned(tree) if context.report.has_errors else set())
    for kind, items, declared in (
        ("input", tree.inputs, context.inputs),
        ("function", tree.functions, context.functions),
        ("hub", tree.hubs, context.hubs),
    ):
        for item in items:
            is_valid = declared.get(item.name.text) is not None
            if is_valid and item.name.text not in used:
                context.report.add(
                    codes.UNUSED_IN_BRIDGE,
                    item.name.span,
                    f"nothing uses the {kind} `{item.name.text}`",
                    help="remove it" if kind == "function" else "remove it, or use it in an output",
                )


def _mentioned(tree: ast.Bridge) -> set[str]:
    """The words in actions, in the bodies of outputs, and in the values of outputs and hubs."""
    parts = [action.span for action in tree.actions]
    parts += [value.span for hub in tree.hubs for value in hub.values]
    for output in tree.outputs:
        parts += [each.span for each in (output.value, *output.fields) if each is not None]
    return {word for part in parts for word in re.findall(r"\w+", part.text)}
