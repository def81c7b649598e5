"""The devices of a component as its deployment describes them, for a component that hosts devices.

In: the environment that the deployment engine gives to the process. Out: a description. In the
worker: `self.devices = Conductor(described(os.environ), kinds)`, `start` in `initialize` and
`shutdown` in `finalize`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping

from robocomp_dsl.hardware.plumbing.description import Plumbing
from robocomp_dsl.hardware.plumbing.read import BadDescription, plumbing_of

VARIABLE = "ROBOCOMP_DEVICES"
"""Holds the description as JSON, in the form of `read.py`."""


def described(environment: Mapping[str, str]) -> Plumbing:
    """The description; one without devices where nothing is said. Raises `BadDescription`."""
    text = environment.get(VARIABLE, "")
    if not text:
        return Plumbing(())
    try:
        data = json.loads(text)
    except ValueError as error:
        raise BadDescription(f"{VARIABLE} is no JSON: {error}") from None
    return plumbing_of(data)
