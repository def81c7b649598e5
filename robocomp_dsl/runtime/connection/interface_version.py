"""Operations that a peer with another version of an interface has in common with a port.

In: the own interface, the record of the peer, and the shapes of its operations. Out: the
interface to connect with, which transports use as any other; or why an operation cannot be called.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from typing import TypeAlias

from robocomp_dsl.runtime.component.interface import Interface, Operation
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.data.shape_difference import describe_difference
from robocomp_dsl.runtime.errors import InterfaceMismatch
from robocomp_dsl.runtime.presence.port_record import PortRecord

ShapesOf: TypeAlias = Callable[[PortRecord], dict[str, str] | None]
log = logging.getLogger("robocomp")


def is_other_version(at: Endpoint, peer: PortRecord) -> bool:
    """Whether a component has another version of the interface; other programs have none."""
    return bool(peer.hash) and peer.hash != at.interface.hash.hex()


def shapes_of_peer(at: Endpoint, peer: PortRecord, ask: ShapesOf) -> dict[str, str] | None:
    """The shapes of a peer's operations; None if it does not reply.

    A component of an earlier version of this project does not; its hash does not cover units.
    """
    shapes = ask(peer)
    if shapes is None and peer.hash == at.interface.hash_without_units.hex():
        return at.interface.shapes
    return shapes


class PeerInterface(Interface):
    """An interface as a peer has it: its type hash, and the names and order of its operations.

    Operations with the same shape on both sides are those of the own interface. The others hold
    places only.
    """

    def __init__(self, own: Interface, peer: PortRecord, shapes: Mapping[str, str]) -> None:
        known = {o.name: o for o in own.operations if shapes.get(o.name) == o.shape}
        every = (known.get(name) or Operation(name) for name in shapes)
        super().__init__(own.name, *every, style=own.style)
        self.__dict__["hash"] = bytes.fromhex(peer.hash)
        self._own = own
        self._peer_shapes = shapes
        self._common = frozenset(known)

    def has(self, operation: Operation) -> bool:
        """Whether the peer has the operation with the same shape."""
        return operation.name in self._common

    def log_differences(self, at: Endpoint, peer: PortRecord) -> None:
        """Log a warning that says which messages `peer` does not get from `at`."""
        missing = [o for o in at.interface.published if o.name in self._peer_shapes]
        texts = [f"{o.name}: {self._reason(o, peer)}" for o in missing if not self.has(o)]
        if texts:
            log.warning(
                "%s does not get all messages of %s: %s", peer.component, at.name, "; ".join(texts)
            )

    def _reason(self, operation: Operation, peer: PortRecord) -> str:
        there = self._peer_shapes.get(operation.name)
        if there is None:
            return f"{peer.component} does not have this operation"
        return describe_difference(operation.shape, there)

    def check(self, operation: Operation, at: Endpoint, peer: PortRecord) -> None:
        """Raise `InterfaceMismatch` if the peer lacks the operation, or has another version."""
        if operation.name in self._common:
            return
        raise mismatch(at, peer, operation.name, self._reason(operation, peer))


def mismatch(at: Endpoint, peer: PortRecord, operation: str, reason: str) -> InterfaceMismatch:
    """The error of a call; `reason` may be empty."""
    what = f"{at.interface.name}.{operation}: {reason}; " if reason else ""
    return InterfaceMismatch(
        f"{what}{at.component} and {peer.component} were generated from different versions of"
        f" {at.interface.name}; generate both from the same IDSL file"
    )
