"""Adds monitors to a component. A component without monitors imports nothing for them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import ComponentSpec
from robocomp_dsl.runtime.connection.ports import Ports

if TYPE_CHECKING:
    from robocomp_dsl.runtime.connection.component_monitors import ComponentMonitors


def load_monitors(spec: ComponentSpec, settings: RunSettings) -> ComponentMonitors | None:
    """The monitors of a component; None if it has none. Raises `MonitorError`."""
    if not settings.monitors:
        return None
    from robocomp_dsl.runtime.connection.component_monitors import (  # noqa: PLC0415
        ComponentMonitors,
    )

    return ComponentMonitors(spec, settings)


def monitored_ports(ports: Ports, monitors: ComponentMonitors | None, clock: Clock) -> Ports:
    """`ports` with the monitors, which are created; without monitors `ports` themselves."""
    if monitors is None:
        return ports
    from robocomp_dsl.runtime.connection.monitored_ports import MonitoredPorts  # noqa: PLC0415

    monitors.create(clock)
    return MonitoredPorts(ports, monitors)
