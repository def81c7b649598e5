"""Who may use which keys in the domain of a deployment. Everything else is denied.

In: a resolved deployment and its domain. Out: `AccessRules`, and the section `access_control` of
zenoh's configuration, which is the same for all routers. Pure. Keys are those of `presence.keys`;
the hash of an interface is a wildcard, because components of other versions do not match anyway.

zenoh allows a message if a rule *includes* its key: a subscription to `a/*` needs a rule for `a/*`,
or for more. `ingress` is what a component sends to its router, `egress` what it receives.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from robocomp_dsl.deploy.network.identities import (
    OPERATOR,
    common_name,
    process_names,
    router_name,
    used_hosts,
)
from robocomp_dsl.deploy.network.port_uses import AddedConnection, PortAction, PortUse, port_uses
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.runtime.component.naming import ANY
from robocomp_dsl.runtime.presence.keys import ROUTER_KEY, domain_prefix, escape_chunk

IN, OUT = "ingress", "egress"
PUT, QUERY, REPLY = "put", "query", "reply"
SUBSCRIBE, SERVE = "declare_subscriber", "declare_queryable"
TOKEN, WATCH_TOKENS, ASK_TOKENS = (
    "liveliness_token",
    "declare_liveliness_subscriber",
    "liveliness_query",
)
MESSAGES = (PUT, "delete", QUERY, REPLY, SUBSCRIBE, SERVE, TOKEN, WATCH_TOKENS, ASK_TOKENS)
_ROLES = {
    PortAction.SERVES: "server",
    PortAction.PUBLISHES: "publisher",
    PortAction.SUBSCRIBES: "subscriber",
}


class Grant(NamedTuple):
    """One kind of message, in one direction, with keys that `key` includes."""

    flow: str
    message: str
    key: str


class ComponentAccess(ValueRecord):
    """What one component, or the components of one process, may do.

    `name` is the common name of its certificate.
    """

    name: str
    uses: tuple[PortUse, ...]
    grants: tuple[Grant, ...]


class AccessRules(ValueRecord):
    """The rules of a deployment. `trusted` are the names that may do everything."""

    domain: str
    components: tuple[ComponentAccess, ...]
    trusted: tuple[str, ...]

    def to_zenoh(self) -> dict[str, Any]:
        """The section `access_control` of zenoh's configuration."""
        rules = [_rule("everything", (IN, OUT), MESSAGES, ("**",))]
        subjects = [{"id": "trusted", "cert_common_names": list(self.trusted)}]
        policies = [{"rules": ["everything"], "subjects": ["trusted"]}]
        for index, component in enumerate(self.components):
            own = list(_component_rules(f"{index}", component.grants))
            rules += own
            subjects.append({"id": component.name, "cert_common_names": [component.name]})
            policies.append({"rules": [rule["id"] for rule in own], "subjects": [component.name]})
        return {
            "enabled": True,
            "default_permission": "deny",
            "rules": rules,
            "subjects": subjects,
            "policies": policies,
        }


def access_rules(
    deployment: Deployment, domain: str, added: Iterable[AddedConnection] = ()
) -> AccessRules:
    """The rules of a deployment in `domain`; `added` are added to its connections."""
    processes = process_names(deployment)
    members: dict[str, list[tuple[str, tuple[PortUse, ...]]]] = {}
    for name, uses in port_uses(deployment, added).items():
        members.setdefault(common_name(processes[name]), []).append((name, uses))
    components = tuple(_access(domain, name, parts) for name, parts in members.items())
    routers = (router_name(host) for host in used_hosts(deployment))
    return AccessRules(domain, components, (OPERATOR, *routers))


def component_grants(domain: str, component: str, uses: Iterable[PortUse]) -> Iterator[Grant]:
    """What a component may do that uses its ports in these ways."""
    return _Keys(domain, component).grants(uses)


def _access(
    domain: str, name: str, members: Iterable[tuple[str, tuple[PortUse, ...]]]
) -> ComponentAccess:
    """What the members of a process may do together."""
    uses: dict[PortUse, None] = {}
    grants: dict[Grant, None] = {}
    for member, own in members:
        uses |= dict.fromkeys(own)
        grants |= dict.fromkeys(component_grants(domain, member, own))
    return ComponentAccess(name, tuple(uses), tuple(grants))


def _rule(
    identifier: str, flows: Iterable[str], messages: Iterable[str], keys: Iterable[str]
) -> dict[str, Any]:
    return {
        "id": identifier,
        "permission": "allow",
        "flows": list(flows),
        "messages": list(messages),
        "key_exprs": list(keys),
    }


def _component_rules(prefix: str, grants: Iterable[Grant]) -> Iterator[dict[str, Any]]:
    """One rule for each kind of message and direction."""
    keys: dict[tuple[str, str], list[str]] = {}
    for grant in grants:
        keys.setdefault((grant.flow, grant.message), []).append(grant.key)
    for (flow, message), allowed in keys.items():
        yield _rule(f"{prefix} {flow} {message}", (flow,), (message,), allowed)


class _Keys:
    """The grants of one component."""

    def __init__(self, domain: str, component: str) -> None:
        self._root = domain_prefix(domain)
        self._component = escape_chunk(component)

    def grants(self, uses: Iterable[PortUse]) -> Iterator[Grant]:
        """The grants for all uses of its ports."""
        yield from self._presence()
        for use in uses:
            if use.action in _ROLES:
                yield Grant(IN, TOKEN, self._port_token(use))
            match use.action:
                case PortAction.SERVES:
                    yield from self._serving(use)
                case PortAction.CALLS:
                    yield from self._calling(use)
                case PortAction.PUBLISHES:
                    yield from self._publishing(use)
                case PortAction.SUBSCRIBES:
                    yield from self._subscribing(use)

    def _presence(self) -> Iterator[Grant]:
        """Every component knows the ports of all, and makes its own state known."""
        for key in (f"{self._root}/p/**", f"{self._root}/a/**", f"{ROUTER_KEY}/*"):
            yield Grant(IN, WATCH_TOKENS, key)
            yield Grant(OUT, TOKEN, key)
        # Who serves and subscribes is known anyway. A program that did not know would send nothing,
        # and its attempt would not be in the log of the router.
        for kind in ("q", "n", "l", "h", "i"):
            yield Grant(OUT, SERVE, f"{self._root}/{kind}/**")
        for kind in ("t", "c"):
            yield Grant(OUT, SUBSCRIBE, f"{self._root}/{kind}/**")
        # The shapes of operations are no secret, either: they explain why versions do not fit.
        yield from self._answering(f"{self._root}/i/{self._component}/*/*")
        yield from self._asking(f"{self._root}/i/**")
        yield Grant(IN, ASK_TOKENS, f"{self._root}/p/server/**")
        yield Grant(IN, TOKEN, f"{self._root}/s/{self._component}/*/*")

    def _port_token(self, use: PortUse) -> str:
        interface, port = escape_chunk(use.interface), escape_chunk(use.port)
        role = _ROLES[use.action]
        return f"{self._root}/p/{role}/{interface}/{self._component}/{port}/*/*/*/*"

    def _key(self, kind: str, use: PortUse, component: str, port: str) -> str:
        return f"{self._root}/{kind}/{escape_chunk(use.interface)}/*/{component}/{port}/*"

    def _own(self, kind: str, use: PortUse) -> str:
        return self._key(kind, use, self._component, escape_chunk(use.port))

    def _peer(self, kind: str, use: PortUse) -> str:
        return self._key(kind, use, _chunk(use.peer), _chunk(use.peer_port))

    def _answering(self, key: str, *asked: str) -> Iterator[Grant]:
        """Answer queries at `key`, also those that ask for it with a wildcard."""
        yield Grant(IN, SERVE, key)
        yield Grant(IN, REPLY, key)
        for each in asked or (key,):
            yield Grant(OUT, QUERY, each)

    def _asking(self, key: str, *asked: str) -> Iterator[Grant]:
        """Ask for `key`, also with a wildcard; only replies at `key` arrive."""
        for each in asked or (key,):
            yield Grant(IN, QUERY, each)
        yield Grant(OUT, REPLY, key)

    def _serving(self, use: PortUse) -> Iterator[Grant]:
        if use.queries and use.on_house:
            yield from self._answering(self._own("q", use))
        if use.commands and use.on_house:
            yield Grant(IN, SUBSCRIBE, self._own("c", use))
            yield Grant(OUT, PUT, self._own("c", use))

    def _calling(self, use: PortUse) -> Iterator[Grant]:
        if use.queries and use.on_house:
            yield from self._asking(self._peer("q", use))
        if use.commands and use.on_house:
            yield Grant(IN, PUT, self._peer("c", use))

    def _publishing(self, use: PortUse) -> Iterator[Grant]:
        if use.on_house:
            yield Grant(IN, PUT, self._own("t", use))
        yield Grant(IN, TOKEN, f"{self._root}/a/{self._component}/{escape_chunk(use.port)}/*/*")
        yield from self._answering(self._own("n", use), f"{self._root}/n/**")
        yield from self._answering(self._own("l", use))
        yield from self._answering(f"{self._root}/h/{self._component}")

    def _subscribing(self, use: PortUse) -> Iterator[Grant]:
        if use.on_house:
            yield Grant(IN, SUBSCRIBE, self._peer("t", use))
            yield Grant(OUT, PUT, self._peer("t", use))
        yield from self._asking(self._peer("n", use), f"{self._root}/n/**")
        yield from self._asking(self._peer("l", use))
        yield from self._asking(f"{self._root}/h/{_chunk(use.peer)}")


def _chunk(name: str) -> str:
    """A name as a chunk of a key; `ANY` is the wildcard."""
    return ANY if name == ANY else escape_chunk(name)
