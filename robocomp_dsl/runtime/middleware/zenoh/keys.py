"""The key expressions of a domain, and what goes into the attachment of a message.

    rc/<domain>/q/<interface>/<hash>/<component>/<port>/<operation>  queries, answered
    rc/<domain>/c/<interface>/<hash>/<component>/<port>/<operation>  commands
    rc/<domain>/t/<interface>/<hash>/<component>/<port>/<operation>  publications
    rc/<domain>/p/<role>/<interface>/<component>/<port>/<hash>       token: this port is served
    rc/<domain>/s/<component>/<pid>/<state>                          token: this component is alive

The hash is that of the interface's shape: bytes of another shape are not even routed to a port, and
the tokens tell both sides that they differ. Every `NUMBERED_EACH`th publication has an attachment:
how many its publisher has sent before (4 bytes, little endian), from which a subscriber knows what
it has lost. (An attachment to every message was measured to cost a tenth of a round trip.)
"""

from __future__ import annotations

from dataclasses import dataclass
from struct import Struct
from typing import Literal
from urllib.parse import quote, unquote

from robocomp_dsl.runtime.middleware.base import Endpoint

NUMBERED_EACH = 16
NUMBER = Struct("<I")
Kind = Literal["q", "c", "t"]


def part(text: str) -> str:
    """`text` as one chunk of a key."""
    return quote(text, safe=":") or "_"


def root(domain: str) -> str:
    """What all keys of a domain begin with."""
    return f"rc/{part(domain)}"


def interface_key(domain: str, kind: Kind, at: Endpoint) -> str:
    """The key of all ports with an interface of one shape."""
    return f"{root(domain)}/{kind}/{part(at.interface.name)}/{at.interface.hash.hex()}"


def port_key(domain: str, kind: Kind, at: Endpoint) -> str:
    """The key of a port, without the operation."""
    return f"{interface_key(domain, kind, at)}/{part(at.component)}/{part(at.port)}"


def publisher_of(key: str) -> str:
    """The component that a publication comes from."""
    return unquote(key.split("/")[5])


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
