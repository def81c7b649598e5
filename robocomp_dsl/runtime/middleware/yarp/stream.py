"""A connection that is also read by lines, as the text carriers and the name server need."""

from __future__ import annotations

from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost, TcpStream

MAX_LINE = 1 << 24
"""Bytes of a line of a text carrier."""


class YarpStream(TcpStream):
    """One connection of a port."""

    def line(self) -> str:
        """The next line without its end. Raises `ConnectionLost`, also for a line too long."""
        parts: list[bytes] = []
        size = 0
        while (end := self._buffer.find(b"\n", self._at)) < 0:
            parts.append(self._buffer[self._at :])
            size += len(parts[-1])
            if size > MAX_LINE:
                raise ConnectionLost(f"a line has more than {MAX_LINE} bytes")
            self._buffer, self._at = self._receive(), 0
        parts.append(self.take(end + 1 - self._at))
        return b"".join(parts).decode(errors="surrogateescape").rstrip("\r\n")

    def send_line(self, text: str) -> None:
        """Send a line. Raises `ConnectionLost`."""
        self.send(text.encode(errors="surrogateescape") + b"\r\n")
