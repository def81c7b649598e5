"""Review how old code uses the ports of its component.

In: the worker, the new component. Out: findings about proxies and handlers that the interfaces, as
they were found, do not have.
"""

from __future__ import annotations

import ast

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes as generator_codes
from robocomp_dsl.generate.python.component_names import SERVED_ROLES, names_of
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.migrate.imports import span_of
from robocomp_dsl.migrate.worker_codes import MISSING_NAME
from robocomp_dsl.model.component import Component

_PROXY = "_proxy"
FAILING = frozenset({generator_codes.CHANGED_SIGNATURE, generator_codes.UNKNOWN_OPERATION})
"""Warnings of the generator about calls that fail in a worker that was just migrated."""


def review_ports(user: UserModule, component: Component, report: Report) -> None:
    """Report proxies of no port, and handlers of no operation."""
    if user.worker is None:
        return
    called = names_of(component)
    proxies = set(called.proxies.values())
    handlers = set(called.handlers.values())
    prefixes = tuple(f"{port.name}_" for port in component.ports if port.role in SERVED_ROLES)
    attributes = [n for n in ast.walk(user.worker) if isinstance(n, ast.Attribute) and _is_own(n)]
    stored = {n.attr for n in attributes if isinstance(n.ctx, ast.Store)}
    loaded = {n.attr for n in attributes if isinstance(n.ctx, ast.Load)}
    for node in attributes:
        if node.attr.endswith(_PROXY) and node.attr not in proxies | stored:
            message = f"the component has no port for `self.{node.attr}`"
            report.add(MISSING_NAME, span_of(user, node), message)
    for method in user.worker.body:
        if not isinstance(method, ast.FunctionDef) or not method.name.startswith(
            prefixes or ("/",)
        ):
            continue
        if method.name not in handlers | loaded:
            operation = method.name.partition("_")[2]
            message = f"`{method.name}` is never called: the IDSL file has no `{operation}`"
            report.add(MISSING_NAME, user.span_of(method), message)


def add_as_errors(found: Report, report: Report) -> None:
    """Add the findings of the generator; those about calls that fail become errors."""
    for finding in found:
        if finding.code not in FAILING:
            report.extend([finding])
            continue
        label = finding.label or finding.help
        message = f"{finding.message}: {label}" if label else finding.message
        report.add(MISSING_NAME, finding.span, message, notes=finding.notes)


def _is_own(node: ast.Attribute) -> bool:
    return isinstance(node.value, ast.Name) and node.value.id == "self"
