"""The wire format of rmw_zenoh: key expressions, liveliness tokens, attachments.

In: names, types and hashes of ROS. Out: the texts and bytes that `rmw_zenoh_cpp` uses (its
docs/design.md, and its attachments since the serialization format of zenoh 1.0).
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from hashlib import blake2b
from typing import Literal

from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.errors import MalformedMessage

EndpointKind = Literal["MP", "MS", "SS", "SC"]
"""Publisher, subscription, service server, service client."""
TOKENS = "@ros2_lv"
DEFAULT_DEPTH = 10
_ATTACHMENT = struct.Struct("<qqB16s")
_GID_SIZE = 16


def dds_type(type_id: str) -> str:
    """`std_msgs::msg::dds_::String_` for `std_msgs/msg/String`."""
    package, kind, name = type_id.split("/")
    return f"{package}::{kind}::dds_::{name}_"


def ros_type(dds_name: str) -> str:
    """The inverse of `dds_type`; other names are returned unchanged."""
    parts = dds_name.split("::")
    if len(parts) != 4 or parts[2] != "dds_" or not parts[3].endswith("_"):
        return dds_name
    return f"{parts[0]}/{parts[1]}/{parts[3][:-1]}"


@dataclass(frozen=True, slots=True)
class TopicInfo:
    """A topic or service: its name, as in `/scan`, its type and the hash of the type."""

    name: str
    type_id: str
    hash: str

    def key(self, domain_id: int) -> str:
        """The key of its messages or requests."""
        return f"{domain_id}/{self.name.lstrip('/')}/{dds_type(self.type_id)}/{self.hash}"


@dataclass(frozen=True, slots=True)
class NodeInfo:
    """A node of ROS; `zid` is the identity of its zenoh session."""

    domain_id: int
    zid: str
    id: int
    namespace: str
    name: str

    def token(self) -> str:
        """Its liveliness token."""
        return self._token(self.id, "NN")

    def endpoint_token(self, id_: int, kind: EndpointKind, info: TopicInfo, qos: str) -> str:
        """The liveliness token of a publisher, subscription, server or client."""
        of_type = f"{dds_type(info.type_id)}/{info.hash}"
        return f"{self._token(id_, kind)}/{_mangled(info.name)}/{of_type}/{qos}"

    def _token(self, id_: int, kind: str) -> str:
        namespace = "%" if self.namespace == "/" else _mangled(self.namespace)
        identity = f"{self.domain_id}/{self.zid}/{self.id}/{id_}"
        return f"{TOKENS}/{identity}/{kind}/%/{namespace}/{self.name}"


@dataclass(frozen=True, slots=True)
class RemoteEndpoint:
    """An endpoint that a liveliness token announces; `node` as in `/left/arm`."""

    kind: str
    node: str
    info: TopicInfo


def parse_endpoint(token: str) -> RemoteEndpoint | None:
    """The endpoint of a liveliness token; None if it announces none."""
    parts = token.split("/")
    if len(parts) != 13 or parts[0] != TOKENS:
        return None
    kind, _, namespace, node, name, type_, hash_ = parts[5:12]
    full = f"{'' if namespace == '%' else _unmangled(namespace)}/{node}"
    return RemoteEndpoint(kind, full, TopicInfo(_unmangled(name), ros_type(type_), hash_))


def _mangled(name: str) -> str:
    return name.replace("/", "%")


def _unmangled(name: str) -> str:
    return name.replace("%", "/")


def qos_text(qos: Qos) -> str:
    """Reliability, durability, history and depth, then deadline, lifespan and liveliness.

    Values that are left out are the default of rmw_zenoh; its default durability depends on its
    version, so that it is always stated.
    """
    reliability = 2 if qos.reliable is False else 1
    durability = 1 if qos.latched else 2
    history = f"{2 if qos.keep_all else 1},{qos.depth or DEFAULT_DEPTH}"
    deadline = ","
    if qos.deadline:
        seconds, nanoseconds = divmod(round(qos.deadline * 1e9), 10**9)
        deadline = f"{seconds},{nanoseconds}"
    return f"{reliability}:{durability}:{history}:{deadline}:,:,,"


def gid_of(token: str) -> bytes:
    """The global identity of an endpoint, 16 bytes that are unique as its token is."""
    return blake2b(token.encode(), digest_size=_GID_SIZE).digest()


def attachment(sequence: int, time_ns: int, gid: bytes) -> bytes:
    """Sequence number, source timestamp and identity of the source."""
    return _ATTACHMENT.pack(sequence, time_ns, _GID_SIZE, gid)


def parse_attachment(data: bytes) -> tuple[int, int, bytes]:
    """Sequence number, source timestamp in ns and identity. Raises `MalformedMessage`."""
    if len(data) != _ATTACHMENT.size or data[16] != _GID_SIZE:
        raise MalformedMessage(
            f"an attachment of {len(data)} bytes; rmw_zenoh sends {_ATTACHMENT.size}"
            " (sequence number, timestamp, 16 bytes of identity)"
        )
    sequence, time_ns, _, gid = _ATTACHMENT.unpack(data)
    return sequence, time_ns, gid
