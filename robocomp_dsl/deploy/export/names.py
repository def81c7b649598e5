"""Names of services: what DNS and Kubernetes accept. Pure."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from hashlib import sha256

MAX_LABEL = 40
"""A DNS label has at most 63 characters; names of further objects are longer by a suffix."""
_OTHER = re.compile(r"[^a-z0-9]+")


def service_names(names: Iterable[str], reserved: Iterable[str] = ()) -> dict[str, str]:
    """A service name for each name: `left/arm` is `left-arm`.

    Names that would be equal or too long end with a part of their hash.
    """
    plain = {name: _OTHER.sub("-", name.lower()).strip("-") or "x" for name in names}
    uses = Counter([*plain.values(), *reserved])
    return {name: _unique(name, text, uses[text]) for name, text in plain.items()}


def service_name(name: str) -> str:
    """The service name of one name."""
    return service_names([name])[name]


def _unique(name: str, text: str, uses: int) -> str:
    # A label begins with a letter in some kinds of objects.
    text = text if text[0].isalpha() else f"c-{text}"
    if uses == 1 and len(text) <= MAX_LABEL:
        return text
    return f"{text[: MAX_LABEL - 7].rstrip('-')}-{sha256(name.encode()).hexdigest()[:6]}"
