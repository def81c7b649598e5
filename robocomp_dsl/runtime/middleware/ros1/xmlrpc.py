"""Calls of the XML-RPC interfaces of ROS 1, which return `[code, message, value]`.

In: the URI of a master or a node, a method, arguments. Out: the value, or `RosApiError` with the
reason. (http://wiki.ros.org/ROS/Master_API, http://wiki.ros.org/ROS/Slave_API)
"""

from __future__ import annotations

import http.client
import xmlrpc.client
from typing import Any
from xml.parsers.expat import ExpatError

from robocomp_dsl.runtime.middleware.tcp.stream import failure_reason

SUCCESS = 1


class RosApiError(Exception):
    """A call failed. `is_unreachable`: nobody replies there."""

    def __init__(self, reason: str, *, is_unreachable: bool = False) -> None:
        super().__init__(reason)
        self.is_unreachable = is_unreachable


class _Transport(xmlrpc.client.Transport):
    """HTTP with a timeout."""

    def __init__(self, timeout: float) -> None:
        super().__init__()
        self._timeout = timeout

    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        connection = super().make_connection(host)
        connection.timeout = self._timeout
        return connection


class RosApi:
    """The interface of one master or node; for one thread at a time."""

    def __init__(self, uri: str, timeout: float) -> None:
        self.uri = uri
        self._transport = _Transport(timeout)
        self._proxy = xmlrpc.client.ServerProxy(uri, self._transport, allow_none=True)

    def call(self, method: str, *arguments: Any) -> Any:
        """The value that a method returns. Raises `RosApiError`."""
        try:
            reply: Any = getattr(self._proxy, method)(*arguments)
        except TimeoutError:
            self._transport.close()
            reason = f"{self.uri} does not reply"
            raise RosApiError(reason, is_unreachable=True) from None
        except (OSError, http.client.HTTPException) as error:
            self._transport.close()
            reason = f"{self.uri} cannot be reached: {failure_reason(error)}"
            raise RosApiError(reason, is_unreachable=True) from None
        except xmlrpc.client.Fault as error:
            raise RosApiError(f"{self.uri}: {method} failed: {error.faultString}") from None
        except (xmlrpc.client.Error, ExpatError, ValueError, UnicodeError) as error:
            self._transport.close()
            raise RosApiError(f"{self.uri} is no ROS node: {error}") from None
        if not (isinstance(reply, list) and len(reply) == 3 and isinstance(reply[0], int)):
            raise RosApiError(f"{self.uri}: {method} returned {reply!r:.60}")
        code, message, value = reply
        if code != SUCCESS:
            raise RosApiError(str(message) or f"{method} failed")
        return value

    def close(self) -> None:
        """Release the connection."""
        self._transport.close()
