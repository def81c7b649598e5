"""What a component was denied, in the words of its description.

In: a denial with zenoh's action and a key of `presence.keys`. Out: a sentence, and its parts as
fields of the log line.
"""

from __future__ import annotations

from typing import NamedTuple
from urllib.parse import unquote

from robocomp_dsl.runtime.router.zenoh_log import Denial

_VERBS = {
    ("Put", "t"): "publishes",
    ("Put", "c"): "sends commands to",
    ("Declare Subscriber", "t"): "subscribes to",
    ("Declare Subscriber", "c"): "serves commands of",
    ("Query", "q"): "calls",
    ("Query", "l"): "asks for the latest messages of",
    ("Query", "n"): "asks for the numbers of",
    ("Query", "h"): "asks for a sign of life of",
    ("Declare Queryable", "q"): "serves",
    ("Declare Queryable", "l"): "offers latest messages of",
    ("Declare Queryable", "n"): "offers numbers of",
    ("Declare Queryable", "h"): "answers for",
    ("Reply", "q"): "replies as",
    ("Liveliness Token", "p"): "makes known",
    ("Liveliness Token", "s"): "reports the state of",
    ("Liveliness Token", "a"): "announces a publisher of",
}
_ROLES = {"server": "serves", "publisher": "publishes", "subscriber": "subscribes to"}


class _Port(NamedTuple):
    interface: str
    name: str


def describe_denial(name: str, denial: Denial) -> tuple[str, dict[str, str]]:
    """A sentence about what `name` was denied, and the fields of the log line."""
    if not denial.action:
        text = (
            f"denied: {name} is no component of this deployment, and may do nothing; if it was"
            " added to the DDSL file, run `rcdeploy up`"
        )
        return text, {"denied": name}
    kind, port = _parse(denial.key)
    verb = _VERBS.get((denial.action, kind))
    if kind == "p" and verb:
        verb = _ROLES.get(denial.key.split("/")[3], verb)
    if verb is None or not port.name:
        use = f"{denial.action.lower()} of the key {denial.key}"
    else:
        use = f"{verb} {port.name}" + (f" ({port.interface})" if port.interface else "")
    text = (
        f"denied: {name} {use}, which its description and the deployment do not declare; if it"
        " should, add it to the CDSL file or connect it in the DDSL file, and run `rcdeploy up`"
    )
    fields = {"denied": name, "action": denial.action, "key": denial.key}
    return text, fields


def _parse(key: str) -> tuple[str, _Port]:
    """The kind of a key, and the port that it belongs to; empty texts for any other key."""
    chunks = [unquote(chunk) for chunk in key.split("/")]
    if len(chunks) < 4 or chunks[0] != "rc":
        return "", _Port("", "")
    kind = chunks[2]
    match kind:
        case "q" | "c" | "t" | "n" | "l" if len(chunks) > 6:
            operation = f" {chunks[7]}" if len(chunks) > 7 and chunks[7] != "*" else ""
            return kind, _Port(chunks[3], f"{chunks[5]}.{chunks[6]}{operation}")
        case "p" if len(chunks) > 6:
            return kind, _Port(chunks[4], f"{chunks[5]}.{chunks[6]}")
        case "a" if len(chunks) > 4:
            return kind, _Port("", f"{chunks[3]}.{chunks[4]}")
        case "s" | "h":
            return kind, _Port("", chunks[3])
        case _:
            return kind, _Port("", "")
