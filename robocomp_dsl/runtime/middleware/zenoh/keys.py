"""The key expressions of a domain, and what goes into the attachment of a message.

    rc/<domain>/q/<interface>/<component>/<port>/<operation>    queries, answered
    rc/<domain>/c/<interface>/<component>/<port>/<operation>    commands
    rc/<domain>/t/<interface>/<component>/<port>/<operation>    publications
    rc/<domain>/p/<role>/<interface>/<component>/<port>/<hash>  token: this port is served
    rc/<domain>/s/<component>/<pid>/<state>                     token: this component is alive

The attachment is the hash of the interface's shape (8 bytes), then the number of the message of
its sender and operation (4 bytes, little endian, publications only).
"""

from __future__ import annotations

from dataclasses import dataclass
from struct import Struct
from typing import Literal
from urllib.parse import quote, unquote

from robocomp_dsl.runtime.middleware.base import Endpoint

HASH_SIZE = 8
NUMBERED = Struct("<8sI")
Kind = Literal["q", "c", "t"]


def part(text: str) -> str:
    """`text` as one chunk of a key."""
    return quote(text, safe=":") or "_"


def root(domain: str) -> str:
    """What all keys of a domain begin with."""
    return f"rc/{part(domain)}"


def port_key(domain: str, kind: Kind, at: Endpoint) -> str:
    """The key of a port, without the operation."""
    name, component, port = part(at.interface.name), part(at.component), part(at.port)
    return f"{root(domain)}/{kind}/{name}/{component}/{port}"


@dataclass(frozen=True, slots=True)
class Present:
    """What the token of a port says; `role` is `server`, `publisher` or `subscriber`."""

    role: str
    interface: str
    component: str
    port: str
    hash: str

    def key(self, domain: str) -> str:
        """The key of the token."""
        said = (self.role, self.interface, self.component, self.port, self.hash)
        return f"{root(domain)}/p/{'/'.join(part(one) for one in said)}"


def parse_present(key: str) -> Present | None:
    """The inverse of `Present.key`; None for anything else."""
    chunks = [unquote(chunk) for chunk in key.split("/")]
    return Present(*chunks[3:]) if len(chunks) == 8 and chunks[2] == "p" else None


def state_key(domain: str, component: str, pid: int, state: str) -> str:
    """The key of the token of a component in a state."""
    return f"{root(domain)}/s/{part(component)}/{pid}/{part(state)}"


def parse_state(key: str) -> tuple[str, int, str] | None:
    """Component, pid and state of a token; None for any other key."""
    chunks = [unquote(chunk) for chunk in key.split("/")]
    if len(chunks) != 6 or chunks[2] != "s" or not chunks[4].isdigit():
        return None
    return chunks[3], int(chunks[4]), chunks[5]
