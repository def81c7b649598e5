"""Whether generated code is what its description would give now.

In: a deployment. Out: a warning for each component whose `generated/` is older than its sources:
it would run, but may know other parameters and interfaces than the deployment was checked with.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.deploy import codes
from robocomp_dsl.deploy.preflight import short
from robocomp_dsl.diagnostics import Diagnostic
from robocomp_dsl.generate import plan
from robocomp_dsl.generate.write import CannotWrite, compare
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment

LANGUAGE = "python"


def outdated(deployment: Deployment, middlewares: Iterable[str]) -> Iterator[Diagnostic]:
    """One warning for a component, however many instances it has."""
    known = tuple(middlewares)
    judged: set[Component] = set()
    for instance in deployment.instances:
        component = instance.component
        if component in judged:
            continue
        judged.add(component)
        changed = _changed(component, known)
        if changed:
            yield Diagnostic(
                codes.OUTDATED,
                instance.span,
                f"the generated code of `{component.name}` is not what its description gives now",
                label=", ".join(changed),
                help=f"rcgen component {short(component.path)}",
            )


def _changed(component: Component, middlewares: tuple[str, ...]) -> list[str]:
    """The files that would change; it may have been generated for another middleware."""
    best: list[str] | None = None
    for middleware in dict.fromkeys((component.middleware, *middlewares)):
        files = [f for f in plan(component, language=LANGUAGE, middleware=middleware) if not f.keep]
        try:
            changes = compare(component.path.parent, files)
        except CannotWrite:
            return []
        found = [one.file.path for one in changes if one.pending]
        if best is None or len(found) < len(best):
            best = found
        if not best:
            break
    return best or []
