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
from robocomp_dsl.runtime.middleware.yarp import wire
from robocomp_dsl.runtime.middleware.yarp.description import MAX_MESSAGE_BYTES

Part = bytes | memoryview


class OutgoingMessage:
    """A message without a reply. Raises `EncodeError` if it is too large.

    `size` are the bytes of the Bottle, `parts` and `wire_size` those of the message in binary form.
    """

    def __init__(self, bottle: Bottle, profile: Profile, envelope: str = "") -> None:
        payload = write_parts(bottle, profile)
        self.size = sum(map(len, payload))
        if self.size > MAX_MESSAGE_BYTES:
            raise EncodeError(f"a message has at most {MAX_MESSAGE_BYTES} bytes")
        head = wire.frame_head(self.size, "D", envelope)
        self.parts: list[Part] = [head, *payload]
        self.wire_size = len(head) + self.size
        self._bottle = bottle
        self._envelope = envelope
        self._owned: dict[bool, bytes] = {}

    def owned(self, *, text: bool) -> bytes:
        """All bytes, in memory that nobody changes."""
        if text not in self._owned:
            self._owned[text] = self._text() if text else b"".join(self.parts)
        return self._owned[text]

    def _text(self) -> bytes:
        head = f"D {self._envelope}" if self._envelope else "D"
        return f"{head}\r\n{write_text(self._bottle)}\r\n".encode(errors="surrogateescape")

    def rest(self, sent: int) -> Part:
        """The bytes behind the first `sent`, in memory that nobody changes."""
        if False in self._owned or not sent:
            return memoryview(self.owned(text=False))[sent:]
        rest = []
        for part in self.parts:
            if sent < len(part):
                rest.append(memoryview(part)[sent:])
            sent = max(0, sent - len(part))
        return b"".join(rest)
