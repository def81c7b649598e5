"""The sequence number of a publication, as it travels with the message."""

from __future__ import annotations

from struct import Struct

SEQUENCE_FORMAT = Struct("<QQ")
"""Id of the publisher, and the number of messages that it published before in this operation."""
