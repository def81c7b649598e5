"""Which addresses YARP allows; it loads quickly, as checks of descriptions use it."""

import re

CARRIERS = ("tcp", "fast_tcp", "text", "text_ack")
ADDRESS = re.compile(r"(?:([a-z_]+):)?(/+[^@\s]+)(?:@(\[[0-9a-fA-F:.]+\]|[^:@\s\[\]]+):(\d{1,5}))?")
"""Carrier, name, host and TCP port."""
MAX_PORT = 65535


def address_problem(text: str) -> str:
    """What is wrong with `[CARRIER:]/NAME[@HOST:PORT]`; empty if nothing is."""
    found = ADDRESS.fullmatch(text.strip())
    if not found or int(found[4] or 0) > MAX_PORT:
        return (
            f"`{text}` is no address of YARP; write a name such as /robot/laser:o,"
            " fast_tcp:/robot/laser:o, or /robot/laser:o@10.0.0.2:10005"
        )
    if found[1] and found[1] not in CARRIERS:
        return f"the carrier `{found[1]}` is not supported; known: {', '.join(CARRIERS)}"
    if not found[2].strip("/"):
        return f"`{text}` names no port; write such as /robot/laser:o"
    return ""
