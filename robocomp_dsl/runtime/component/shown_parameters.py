"""The parameters of a component for transports that show them to their own tools.

In: the parameters and the callback group. Out: descriptions, and changes, all or none, whose hooks
run in the callback group.
"""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.parameters import ParameterRejected, Parameters
from robocomp_dsl.runtime.parameters.values import Description

BUSY_TIMEOUT_S = 1.0
"""A change waits this long for a running callback."""


class ShownParameters:
    """Parameters as a transport sees them."""

    def __init__(self, params: Parameters, callback_group: CallbackGroup) -> None:
        self._params = params
        self._callback_group = callback_group

    def describe(self) -> list[Description]:
        """Every parameter with its value, range and documentation."""
        return self._params.describe()

    def set_text(self, changes: Mapping[str, str]) -> None:
        """Change live parameters, all or none. Raises `ParameterRejected`."""
        if not self._callback_group.enter(BUSY_TIMEOUT_S):
            raise ParameterRejected(f"the component was busy for {BUSY_TIMEOUT_S:g} s; try again")
        try:
            self._params.set_text(changes)
        finally:
            self._callback_group.leave()
