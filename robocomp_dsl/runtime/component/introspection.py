"""Serves the interfaces `Component` and `ComponentSchema`, which every component has.

In: a runner. Out: handlers. They run in their own callback group: a component whose `compute` hangs
can still be inspected and stopped.
"""

from __future__ import annotations

import os
import socket
import sys
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Protocol

from robocomp_dsl.runtime.component import logs
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.component_interface import (
    COMPONENT,
    ComponentInfo,
    LifeState,
    OperationStatistics,
    ParameterInfo,
    PortInfo,
    Refusal,
    Statistics,
)
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.lifecycle import Lifecycle
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort, ComponentSpec, ServedPort
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.component.statistics import Statistics as RunStatistics
from robocomp_dsl.runtime.connection.connections_interface import COMPONENTCONNECTIONS
from robocomp_dsl.runtime.dynamic.schema_interface import COMPONENTSCHEMA, Schema
from robocomp_dsl.runtime.parameters import ParameterRejected, Parameters
from robocomp_dsl.runtime.parameters.value_list import format_list

MAX_PERIOD_MS = 3_600_000
_PORT_ROLES = {
    "implements": "implements",
    "requires": "requires",
    "publishes": "publishes",
    "subscribesTo": "subscribes",
}


class InspectedRunner(Protocol):
    """What the servant reads of a runner."""

    name: str
    spec: ComponentSpec
    params: Parameters
    lifecycle: Lifecycle
    statistics: RunStatistics
    callback_group: CallbackGroup
    started: float

    @property
    def settings(self) -> RunSettings:
        """The settings in force."""

    @property
    def worker(self) -> object:
        """The object of the user's class."""

    def middlewares_of(self, port: ServedPort | CalledPort) -> tuple[str, ...]:
        """The middlewares of a port, in order of preference."""

    def stop(self) -> None:
        """Request a stop; returns immediately."""


class Introspection:
    """The servant of `Component` and `ComponentSchema`."""

    def __init__(self, runner: InspectedRunner) -> None:
        self._runner = runner
        self._schema: Schema | None = None
        self.callback_group = CallbackGroup()

    def handlers(self) -> Mapping[str, Any]:
        """Handlers by operation name."""
        return {
            "getInfo": self.get_info,
            "getParameters": self.get_parameters,
            "setParameters": self.set_parameters,
            "saveParameters": self.save_parameters,
            "setPeriod": self.set_period,
            "setLogLevel": self.set_log_level,
            "getStatistics": self.get_statistics,
            "stop": self._runner.stop,
        }

    def schema_handlers(self) -> Mapping[str, Any]:
        """Handlers of `ComponentSchema` by operation name."""
        return {"getInterfaces": self.get_interfaces}

    def get_interfaces(self) -> Schema:
        """The types of all ports."""
        # Computed on request: most components are never asked.
        from robocomp_dsl.runtime.dynamic import describe, documentation  # noqa: PLC0415

        if self._schema is None:
            files = self._documentation_files()
            texts = documentation.Documentation(files)
            self._schema = describe.describe_interfaces(self._interfaces(), texts)
        return self._schema

    def _interfaces(self) -> Iterator[Interface]:
        for attribute in _PORT_ROLES.values():
            for port in getattr(self._runner.spec, attribute):
                yield getattr(port, "interface", None) or port.proxy.INTERFACE
        yield from (COMPONENT, COMPONENTSCHEMA, COMPONENTCONNECTIONS)

    def _documentation_files(self) -> Iterator[Path]:
        """`interfaces.json` of the generated package, and those of the runtime's interfaces."""
        for cls in type(self._runner.worker).__mro__:
            path = getattr(sys.modules.get(cls.__module__), "__file__", None)
            if path:
                yield Path(path).with_name("interfaces.json")
        runtime = Path(__file__).parents[1]
        yield runtime / "component" / "component_interface.json"
        yield runtime / "dynamic" / "schema_interface.json"
        yield runtime / "connection" / "connections_interface.json"
        yield runtime / "time" / "clock_interface.json"

    def get_info(self) -> ComponentInfo:
        """Name, state and ports."""
        runner = self._runner
        return ComponentInfo(
            name=runner.name,
            component=runner.spec.name,
            version=runner.spec.version,
            domain=runner.settings.domain,
            host=socket.gethostname(),
            pid=os.getpid(),
            state=LifeState[runner.lifecycle.state.value.capitalize()],
            reason=runner.lifecycle.reason,
            uptime=time.time() - runner.started,
            ports=self._ports(),
            states=list(runner.lifecycle.machine.states) if runner.lifecycle.machine else [],
        )

    def _ports(self) -> list[PortInfo]:
        runner = self._runner
        ports = []
        for role, attribute in _PORT_ROLES.items():
            for port in getattr(runner.spec, attribute):
                interface = getattr(port, "interface", None) or port.proxy.INTERFACE
                looks = role in ("requires", "subscribesTo")
                peers = list(runner.settings.peers_of(port.name)) if looks else []
                name = port.name if looks else runner.settings.remaps.get(port.name, port.name)
                peers += [peer.name for peer in runner.settings.external.get(port.name, ())]
                middlewares = ", ".join(runner.middlewares_of(port))
                ports.append(PortInfo(role, name, interface.name, middlewares, peers))
        return ports

    def get_parameters(self) -> list[ParameterInfo]:
        """All parameters."""
        return [
            ParameterInfo(
                name=counts.name,
                type=counts.type,
                unit=counts.unit,
                live=counts.live,
                low=_format_value(counts.low),
                high=_format_value(counts.high),
                choices=list(counts.choices),
                value=_format_value(counts.value),
                defaultValue=_format_value(counts.default),
                doc=counts.doc,
            )
            for counts in self._runner.params.describe()
        ]

    def set_parameters(self, changes: Mapping[str, str]) -> None:
        """Change all parameters or none; hooks of the user's class run in its callback group."""
        with self._runner.callback_group:
            try:
                self._runner.params.set_text(changes)
            except ParameterRejected as error:
                raise Refusal(str(error)) from None

    def save_parameters(self) -> str:
        """Save the changed live values; returns the path of the file."""
        try:
            return str(self._runner.params.save().resolve())
        except ParameterRejected as error:
            raise Refusal(str(error)) from None

    def set_period(self, period: int) -> None:
        """Set the period, in ms."""
        if not 0 <= period <= MAX_PERIOD_MS:
            raise Refusal(f"period {period} ms is out of range: 0 to {MAX_PERIOD_MS} ms")
        self._runner.lifecycle.set_period(period)

    def set_log_level(self, level: str) -> None:
        """Set the log level of this process."""
        try:
            logs.set_level(level)
        except ValueError as error:
            raise Refusal(str(error)) from None

    def get_statistics(self) -> Statistics:
        """All statistics."""
        figures = self._runner.statistics
        figures.refresh()
        period50, period99 = figures.periods.milliseconds(50, 99)
        compute50, compute99 = figures.computes.milliseconds(50, 99)
        return Statistics(
            period=float(self._runner.lifecycle.period_ms),
            periodP50=period50,
            periodP99=period99,
            jitter=period99 - period50,
            computeP50=compute50,
            computeP99=compute99,
            cycles=figures.computes.count,
            overruns=figures.overruns,
            failures=figures.failures,
            operations=[_operation(operation) for operation in list(figures.operations.values())],
        )


def _operation(counts: OperationCounts) -> OperationStatistics:
    p50, p90, p99, longest = counts.durations.milliseconds(50, 90, 99, 100)
    return OperationStatistics(
        port=counts.port,
        operation=counts.operation,
        calls=counts.calls,
        failures=counts.failures,
        bytesIn=counts.bytes_in,
        bytesOut=counts.bytes_out,
        drops=counts.drops,
        malformed=counts.malformed,
        missed=counts.missed,
        p50=p50,
        p90=p90,
        p99=p99,
        longest=longest,
    )


def _format_value(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, list | tuple):
        return format_list(value)
    return str(value).lower() if isinstance(value, bool) else str(value)
