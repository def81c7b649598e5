"""The parameters of a component on the parameter server of the ROS master.

In: the parameters of the component. Out: ROS parameters `/<node>/<name>`: they are set when a
master appears, and when a parameter of the component changes. `rosparam set` changes live
parameters; the value of another one, or one that is rejected, is set back. Changes arrive within a
second.
"""

from __future__ import annotations

import logging
import threading
from typing import Any

from robocomp_dsl.runtime.component.shown_parameters import ShownParameters
from robocomp_dsl.runtime.component.user_errors import describe_error
from robocomp_dsl.runtime.middleware.ros1.node import RosNode
from robocomp_dsl.runtime.middleware.ros1.xmlrpc import RosApi
from robocomp_dsl.runtime.parameters import ParameterRejected
from robocomp_dsl.runtime.parameters.value_list import format_list
from robocomp_dsl.runtime.parameters.values import Description

_INT32 = range(-(2**31), 2**31)
"""Of XML-RPC; larger integers are set as text."""
log = logging.getLogger("robocomp")


def show_parameters(node: RosNode, parameters: ShownParameters) -> MasterParameters:
    """Show the parameters of a component as those of its node, from now on."""
    shown = MasterParameters(node, parameters)
    node.on_parameter = shown.update
    node.registration.on_master = shown.set_all
    node.registration.on_check = shown.check
    node.registration.start()
    return shown


class MasterParameters:
    """The parameters of one node. The thread that registers the node calls the master."""

    def __init__(self, node: RosNode, parameters: ShownParameters) -> None:
        self._node = node
        self._parameters = parameters
        self._lock = threading.Lock()
        self._changes: dict[str, Any] = {}
        self._shown: dict[str, Any] = {}

    def _key(self, name: str) -> str:
        """`/arm/motors/2/low` for `motors[2].low`."""
        path = name.replace("[", "/").replace("]", "").replace(".", "/")
        return f"{self._node.name}/{path}"

    def set_all(self, api: RosApi) -> None:
        """Set all parameters, and subscribe to changes. Raises `RosApiError`."""
        self._shown = {}
        self._set_changed(api, self._parameters.describe())
        for key in self._shown:
            api.call("subscribeParam", self._node.name, self._node.api_uri, key)

    def _set_changed(self, api: RosApi, described: list[Description]) -> None:
        for each in described:
            key, value = self._key(each.name), ros_value(each.value)
            if key not in self._shown or self._shown[key] != value:
                api.call("setParam", self._node.name, key, value)
                self._shown[key] = value

    def update(self, key: str, value: Any) -> None:
        """The master reports a changed parameter; it is applied by `check`."""
        with self._lock:
            self._changes["/" + key.strip("/")] = value

    def check(self, api: RosApi) -> None:
        """Apply what ROS changed, and show what others changed. Raises `RosApiError`."""
        with self._lock:
            changes, self._changes = self._changes, {}
        described = self._parameters.describe()
        names = {self._key(each.name): each for each in described}
        for key, value in changes.items():
            each = names.get(key)
            if each is not None and ros_value(each.value) != value:
                self._shown[key] = value
                self._apply(each, value)
        self._set_changed(api, self._parameters.describe() if changes else described)

    def _apply(self, described: Description, value: Any) -> None:
        text = str(value).lower() if isinstance(value, bool) else str(value)
        if isinstance(value, list | tuple):
            text = format_list(value)
        try:
            self._parameters.set_text({described.name: text})
        except ParameterRejected as error:
            log.warning("rosparam set %s: %s", self._key(described.name), error)
        except Exception as error:  # of a hook of user code
            reason = describe_error(error)
            log.error("rosparam set %s: %s", described.name, reason)  # noqa: TRY400 - described


def ros_value(value: Any) -> Any:
    """A value as the parameter server has it."""
    if isinstance(value, bool | float | str):
        return value
    if isinstance(value, int):
        return int(value) if value in _INT32 else str(value)
    if isinstance(value, list | tuple):
        return [ros_value(each) for each in value]
    if isinstance(value, dict):
        return {str(key): ros_value(each) for key, each in value.items()}
    return str(value)
