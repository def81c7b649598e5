"""Key expressions of a domain, and the attachments of messages.

    rc/<domain>/q/<interface>/<hash>/<component>/<port>/<operation>  queries
    rc/<domain>/c/<interface>/<hash>/<component>/<port>/<operation>  commands
    rc/<domain>/t/<interface>/<hash>/<component>/<port>/<operation>  publications
    rc/<domain>/p/<role>/<interface>/<component>/<port>/<hash>/<middleware>/<address>/<peers>
                                                                     token: this port exists
    rc/<domain>/s/<component>/<pid>/<state>                          token: this component is alive
    rc/<domain>/a/<component>/<port>/<id>/<created>                  token: a publisher, its id
    rc/<domain>/n/<interface>/<hash>/<component>/<port>/<operation>  number of publications so far
    rc/<domain>/l/<interface>/<hash>/<component>/<port>/<operation>  latest message of a topic
    rc/<domain>/h/<component>                                        sign of life of a component
    rc/<domain>/i/<component>/<interface>/<hash>                     shapes of its operations

The hash is the type hash of the interface: messages of another version are not routed to a port,
and the tokens let both sides detect the difference. A caller uses the hash of its server for the
operations that have the same shape on both sides. Every publication has an attachment with a
sequence number (`sequence.SEQUENCE_FORMAT`), from which a subscriber computes its losses.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal
from urllib.parse import quote, unquote

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.presence.port_record import PortRecord

Kind = Literal["q", "c", "t", "n", "l"]
ROUTER_KEY = "rc-routers"
"""The routers of a deployment have the tokens `rc-routers/<name>`, in no domain."""


def escape_chunk(text: str) -> str:
    """`text` as one chunk of a key expression."""
    return quote(text, safe=":") or "_"


def domain_prefix(domain: str) -> str:
    """The common prefix of all keys of a domain."""
    return f"rc/{escape_chunk(domain)}"


def interface_key(domain: str, kind: Kind, at: Endpoint) -> str:
    """The key prefix of all ports with one version of an interface."""
    name = escape_chunk(at.interface.name)
    return f"{domain_prefix(domain)}/{kind}/{name}/{at.interface.hash.hex()}"


def port_key(domain: str, kind: Kind, at: Endpoint) -> str:
    """The key of a port, without the operation."""
    return f"{interface_key(domain, kind, at)}/{escape_chunk(at.component)}/{escape_chunk(at.port)}"


def heartbeat_key(domain: str, component: str) -> str:
    """The key at which a component answers that it is alive."""
    return f"{domain_prefix(domain)}/h/{escape_chunk(component)}"


def shapes_key(domain: str, component: str, interface: str = "", hash_: str = "") -> str:
    """The key at which a component serves the shapes of an interface; of all if it is empty."""
    root = f"{domain_prefix(domain)}/i/{escape_chunk(component)}"
    return f"{root}/{escape_chunk(interface)}/{hash_}" if interface else f"{root}/*/*"


def publisher_of(key: str) -> str:
    """The component of a publication's key."""
    return unquote(key.split("/")[5])


def record_key(domain: str, record: PortRecord) -> str:
    """The key of the token of a port."""
    chunks = (
        record.role,
        record.interface,
        record.component,
        record.port,
        record.hash,
        record.middleware,
        record.address,
        ",".join(record.peers),
    )
    return f"{domain_prefix(domain)}/p/{'/'.join(escape_chunk(chunk) for chunk in chunks)}"


def parse_record(key: str) -> PortRecord | None:
    """The inverse of `record_key`; None for any other key."""
    chunks = [unquote(chunk) for chunk in key.split("/")]
    if len(chunks) != 11 or chunks[2] != "p":
        return None
    hash_, middleware, address, peers = ("" if chunk == "_" else chunk for chunk in chunks[7:])
    names = tuple(peers.split(",")) if peers else ()
    role, interface, component, port = chunks[3:7]
    return PortRecord(role, interface, component, port, hash_, middleware, address, names)


def state_key(domain: str, component: str, pid: int, state: str) -> str:
    """The key of the token of a component in a state."""
    return f"{domain_prefix(domain)}/s/{escape_chunk(component)}/{pid}/{escape_chunk(state)}"


def parse_state(key: str) -> tuple[str, int, str] | None:
    """Component, pid and state of a state token; None for any other key."""
    chunks = [unquote(chunk) for chunk in key.split("/")]
    if len(chunks) != 6 or chunks[2] != "s" or not chunks[4].isdigit():
        return None
    return chunks[3], int(chunks[4]), chunks[5]


@dataclass(frozen=True, slots=True)
class PublisherToken:
    """The token of a publisher: a random id, and when it was created (monotonic clock, ns).

    `clock` identifies the machine whose clock that is.
    """

    component: str
    port: str
    id: int
    created: int
    clock: str = ""

    def key(self, domain: str) -> str:
        """The key of the token."""
        created = f"{self.created}:{self.clock}" if self.clock else str(self.created)
        chunks = (self.component, self.port, f"{self.id:016x}", created)
        return f"{domain_prefix(domain)}/a/{'/'.join(escape_chunk(chunk) for chunk in chunks)}"


def parse_publisher_token(key: str) -> PublisherToken | None:
    """The inverse of `PublisherToken.key`; None for any other key."""
    chunks = [unquote(chunk) for chunk in key.split("/")]
    if len(chunks) != 7 or chunks[2] != "a":
        return None
    try:
        created, _, clock = chunks[6].partition(":")
        return PublisherToken(chunks[3], chunks[4], int(chunks[5], 16), int(created), clock)
    except ValueError:
        return None


def counts_key(domain: str, component: str, port: str) -> str:
    """The key of the numbers of all operations that a port publishes."""
    return f"{domain_prefix(domain)}/n/*/*/{escape_chunk(component)}/{escape_chunk(port)}/*"
