"""What every component tells of itself: the interface `Component` of `interfaces/Component.idsl`.

In: a runner. Out: handlers. They run under a token of their own: a component whose
`compute` hangs can still be looked at and stopped.
"""

from __future__ import annotations

import os
import socket
import time
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from robocomp_dsl.runtime import logs
from robocomp_dsl.runtime.component_interface import (
    ComponentInfo,
    LifeState,
    OperationStatistics,
    ParameterInfo,
    PortInfo,
    Refusal,
    Statistics,
)
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.parameters import Refused
from robocomp_dsl.runtime.statistics import OperationCounts

if TYPE_CHECKING:
    from robocomp_dsl.runtime.runner import Runner

LONGEST_PERIOD_MS = 3_600_000
_LISTS = {
    "implements": "implements",
    "requires": "requires",
    "publishes": "publishes",
    "subscribesTo": "subscribes",
}


class Introspection:
    """The servant of `Component`."""

    def __init__(self, runner: Runner) -> None:
        self._runner = runner
        self.execution = Execution()

    def handlers(self) -> Mapping[str, Any]:
        """Operation to method."""
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
            state=LifeState[runner.state.value.capitalize()],
            reason=runner.lifecycle.reason,
            uptime=time.time() - runner.started,
            ports=self._ports(),
            states=list(runner.lifecycle.machine.states) if runner.lifecycle.machine else [],
        )

    def _ports(self) -> list[PortInfo]:
        runner = self._runner
        made = []
        for role, attribute in _LISTS.items():
            for port in getattr(runner.spec, attribute):
                interface = getattr(port, "interface", None) or port.proxy.INTERFACE
                looks = role in ("requires", "subscribesTo")
                peers = list(runner.settings.peers_of(port.name)) if looks else []
                name = port.name if looks else runner.settings.remaps.get(port.name, port.name)
                made.append(PortInfo(role, name, interface.name, runner.middleware_name, peers))
        return made

    def get_parameters(self) -> list[ParameterInfo]:
        """All parameters."""
        return [
            ParameterInfo(
                name=one.name,
                type=one.kind,
                unit=one.unit,
                live=one.live,
                low=_shown(one.low),
                high=_shown(one.high),
                choices=list(one.choices),
                value=_shown(one.value),
                defaultValue=_shown(one.default),
                doc=one.doc,
            )
            for one in self._runner.params.describe()
        ]

    def set_parameters(self, changes: Mapping[str, str]) -> None:
        """All or none; the hooks of the user's class run as any handler does."""
        with self._runner.execution:
            try:
                self._runner.params.set_text(changes)
            except Refused as error:
                raise Refusal(str(error)) from None

    def save_parameters(self) -> str:
        """The file in which they are kept."""
        try:
            return str(self._runner.params.save().resolve())
        except Refused as error:
            raise Refusal(str(error)) from None

    def set_period(self, period: int) -> None:
        """In ms."""
        if not 0 <= period <= LONGEST_PERIOD_MS:
            raise Refusal(f"a period is from 0 to {LONGEST_PERIOD_MS} ms, not {period}")
        self._runner.lifecycle.set_period(period)

    def set_log_level(self, level: str) -> None:
        """Of everything in this process."""
        try:
            logs.set_level(level)
        except ValueError as error:
            raise Refusal(str(error)) from None

    def get_statistics(self) -> Statistics:
        """All figures."""
        figures = self._runner.statistics
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
            operations=[_operation(one) for one in list(figures.operations.values())],
        )


def _operation(one: OperationCounts) -> OperationStatistics:
    p50, p90, p99, longest = one.durations.milliseconds(50, 90, 99, 100)
    return OperationStatistics(
        port=one.port,
        operation=one.operation,
        calls=one.calls,
        failures=one.failures,
        bytesIn=one.bytes_in,
        bytesOut=one.bytes_out,
        drops=one.drops,
        malformed=one.malformed,
        missed=one.missed,
        p50=p50,
        p90=p90,
        p99=p99,
        longest=longest,
    )


def _shown(value: object) -> str:
    if value is None:
        return ""
    return str(value).lower() if isinstance(value, bool) else str(value)
