"""The access rules of a deployment as text: what each component may do.

In: `AccessRules`. Out: lines for people, or data for programs. Pure.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from robocomp_dsl.deploy.network.access_rules import AccessRules, ComponentAccess
from robocomp_dsl.deploy.network.port_uses import PortUse
from robocomp_dsl.runtime.component.naming import ANY


def access_text(rules: AccessRules) -> Iterator[str]:
    """One line for each use of a port; what every component may do comes last."""
    yield f"access rules in the domain {rules.domain}; everything else is denied"
    yield f"{' and '.join(rules.trusted)} may do everything"
    for component in rules.components:
        yield ""
        yield component.name
        yield from (f"   {line}" for line in dict.fromkeys(map(_describe, _own_uses(component))))
    yield ""
    yield "every component"
    yield "   makes its own ports and its state known, and sees the ports of all"
    common = (
        [use for use in rules.components[0].uses if _is_common(use)] if rules.components else []
    )
    yield from (f"   {line}" for line in map(_describe, common))


def access_data(rules: AccessRules) -> dict[str, Any]:
    """The rules as JSON data; `grants` are in zenoh's words."""
    return {
        "domain": rules.domain,
        "trusted": list(rules.trusted),
        "components": [
            {
                "name": component.name,
                "uses": [_use_data(use) for use in component.uses],
                "grants": [grant._asdict() for grant in component.grants],
            }
            for component in rules.components
        ],
    }


def _is_common(use: PortUse) -> bool:
    """Whether the runtime of every component has this use."""
    return use.from_runtime and use.port == "Component"


def _own_uses(component: ComponentAccess) -> Iterator[PortUse]:
    return (use for use in component.uses if not _is_common(use))


def _describe(use: PortUse) -> str:
    kinds = [kind for kind, has in (("queries", use.queries), ("commands", use.commands)) if has]
    service = f" ({' and '.join(kinds)})" if use.action in ("serves", "calls") else ""
    over = "" if use.on_house else ", over another middleware"
    match use.peer, use.peer_port:
        case "", _:
            return f"{use.action} {use.interface}{service} as {use.port}{over}"
        case peer, _ if peer == ANY:
            target = "any component"
        case peer, port if port == ANY:
            target = peer
        case peer, port:
            target = f"{peer}.{port}"
    return f"{use.action} {use.interface}{service} of {target} as {use.port}{over}"


def _use_data(use: PortUse) -> dict[str, Any]:
    return {
        "action": str(use.action),
        "interface": use.interface,
        "port": use.port,
        "peer": use.peer,
        "peer_port": use.peer_port,
    }
