"""Finds components whose generated code is outdated.

In: a deployment. Out: a warning for each component whose generated code differs from what rcgen
would write now. Such a component runs, but its interfaces and parameters may not be those that the
deployment was checked with.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from robocomp_dsl.deploy import codes
from robocomp_dsl.deploy.preflight import short_path
from robocomp_dsl.diagnostics import Diagnostic
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.write import CannotWrite, compare
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment

LANGUAGE = "python"


def find_outdated(
    deployment: Deployment, middlewares: Callable[[], Iterable[str]]
) -> Iterator[Diagnostic]:
    """One warning per outdated component, at its first instance.

    `middlewares` returns the names of all middlewares.
    """
    checked: set[Component] = set()
    for instance in deployment.instances:
        component = instance.component
        if component in checked or instance.is_program:
            continue
        checked.add(component)
        changed = _changed_files(component, middlewares)
        if changed:
            yield Diagnostic(
                codes.OUTDATED,
                instance.span,
                f"the generated code of `{component.name}` is outdated",
                label=", ".join(changed),
                help=f"rcgen component {short_path(component.path)}",
            )


def _changed_files(component: Component, middlewares: Callable[[], Iterable[str]]) -> list[str]:
    """The files that would change, for the middleware with the fewest changes.

    The component may have been generated for another middleware than its default.
    """
    best: list[str] | None = None
    for middleware in _names_from(component.middleware, middlewares):
        planned = plan(component, language=LANGUAGE, middleware=middleware)
        files = [file for file in planned if not file.write_once]
        try:
            changes = compare(component.path.parent, files)
        except CannotWrite:
            return []
        found = [change.file.path for change in changes if change.pending]
        if best is None or len(found) < len(best):
            best = found
        if not best:
            break
    return best or []


def _names_from(first: str, others: Callable[[], Iterable[str]]) -> Iterator[str]:
    """`first`, then the others; these are looked up only if they are needed."""
    yield first
    yield from (name for name in others() if name != first)
