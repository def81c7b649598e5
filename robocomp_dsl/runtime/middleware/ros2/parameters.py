"""The parameters of a component as ROS parameters of its node.

In: the parameters of the component. Out: the parameter services of ROS (`ros2 param list`, `get`,
`set`, `describe`): live parameters can be set, all others are read-only. A value that is changed by
other means is shown after a second.
"""

from __future__ import annotations

import logging
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.parameter import Parameter

from robocomp_dsl.runtime.component.shown_parameters import ShownParameters
from robocomp_dsl.runtime.component.user_errors import describe_error
from robocomp_dsl.runtime.parameters import ParameterRejected
from robocomp_dsl.runtime.parameters.value_list import format_list
from robocomp_dsl.runtime.parameters.values import Description

REFRESH_S = 1.0
log = logging.getLogger("robocomp")


class RosParameters:
    """The parameters of one node."""

    def __init__(self, node: Any, parameters: ShownParameters) -> None:
        self._node = node
        self._parameters = parameters
        self._is_refreshing = False
        self._names: set[str] = set()
        for described in parameters.describe():
            node.declare_parameter(described.name, described.value, _descriptor(described))
            self._names.add(described.name)
        node.add_on_set_parameters_callback(self._on_set)
        self._timer = node.create_timer(REFRESH_S, self._refresh)

    def _on_set(self, requested: list[Any]) -> Any:
        """Change the parameters of the component; ROS stores the values if that succeeds."""
        changes = {p.name: _text(p.value) for p in requested if p.name in self._names}
        if self._is_refreshing or not changes:
            return SetParametersResult(successful=True)
        try:
            self._parameters.set_text(changes)
        except ParameterRejected as error:
            return SetParametersResult(successful=False, reason=str(error))
        except Exception as error:  # of a hook of user code
            log.error("set of ROS parameters failed: %s", describe_error(error))  # noqa: TRY400
            return SetParametersResult(successful=False, reason=describe_error(error))
        return SetParametersResult(successful=True)

    def _refresh(self) -> None:
        """Show values that were changed by other means; the thread of the executor calls this."""
        changed = [
            Parameter(described.name, value=described.value)
            for described in self._parameters.describe()
            if described.live
            and not _is_same(self._node.get_parameter(described.name).value, described.value)
        ]
        if changed:
            self._is_refreshing = True
            try:
                self._node.set_parameters(changed)
            finally:
                self._is_refreshing = False


def _descriptor(described: Description) -> Any:
    limits = [
        f"{name} {limit:g}"
        for name, limit in (("min", described.low), ("max", described.high))
        if limit is not None
    ]
    constraints = [", ".join(described.choices), " ".join(limits), described.unit]
    return ParameterDescriptor(
        description=described.doc,
        additional_constraints="; ".join(filter(None, constraints)),
        read_only=not described.live,
        dynamic_typing=True,  # the component converts and checks, so that 2 is a valid float
    )


def _is_same(shown: Any, value: Any) -> bool:
    """Whether ROS shows a value; it shows lists of numbers as arrays."""
    return list(shown) == value if isinstance(value, list) else bool(shown == value)


def _text(value: Any) -> str:
    """A value as on the command line; rclpy gives lists of numbers as arrays."""
    if not isinstance(value, bool | int | float | str):
        return format_list(value)
    return str(value).lower() if isinstance(value, bool) else str(value)
