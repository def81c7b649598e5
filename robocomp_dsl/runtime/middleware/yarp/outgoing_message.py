"""One publication on its way to the readers of a port.

In: a Bottle. Out: the bytes for each carrier. Large values are copied only if a reader does not
take them at once: until `send` returns, their memory is that of the publisher.
"""

from __future__ import annotations

from robocomp_dsl.runtime.codec.bottle.binary_writer import write_parts
from robocomp_dsl.runtime.codec.bottle.profile import Profile
from robocomp_dsl.runtime.codec.bottle.text_writer import write_text
from robocomp_dsl.runtime.codec.bottle.values import Bottle
from robocomp_dsl.runtime.errors import EncodeError
from robocomp_dsl.runtime.middleware.tcp.outgoing_link import TcpMessage
from robocomp_dsl.runtime.middleware.tcp.stream import Part, behind
from robocomp_dsl.runtime.middleware.yarp import wire
from robocomp_dsl.runtime.middleware.yarp.description import MAX_MESSAGE_BYTES


class OutgoingMessage(TcpMessage):
    """A message without a reply. Raises `EncodeError` if it is too large.

    `size` are the bytes of the Bottle; `parts` are the message in binary form.
    """

    def __init__(self, bottle: Bottle, profile: Profile, envelope: str = "") -> None:
        payload = write_parts(bottle, profile)
        self.size = sum(map(len, payload))
        if self.size > MAX_MESSAGE_BYTES:
            raise EncodeError(f"a message has at most {MAX_MESSAGE_BYTES} bytes")
        head = wire.frame_head(self.size, "D", envelope)
        super().__init__(head, *payload)
        self._bottle = bottle
        self._envelope = envelope
        self._copy: bytes | None = None
        self._text: TcpMessage | None = None

    def on_carrier(self, carrier: str) -> TcpMessage:
        """The message in the form of a carrier."""
        if not carrier.startswith("text"):
            return self
        if self._text is None:
            head = f"D {self._envelope}" if self._envelope else "D"
            text = f"{head}\r\n{write_text(self._bottle)}\r\n"
            self._text = TcpMessage(text.encode(errors="surrogateescape"))
        return self._text

    def rest(self, sent: int) -> tuple[Part, ...]:
        """See `TcpMessage`; the copy of a whole message serves all readers."""
        if self._copy is None:
            if sent:
                return (b"".join(behind(self.parts, sent)),)
            self._copy = b"".join(self.parts)
        return (memoryview(self._copy)[sent:],)
