"""Devices served as interfaces: each operation is one call of a servant, when its turn has come.

In: the ports of a component, which devices each stands for, and the devices, simulated or real.
Out: for every port an object with the operations of its interface as methods.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from typing import Any

from robocomp_dsl.hardware.errors import DeviceGone, HardwareError
from robocomp_dsl.hardware.servants import SERVANTS
from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.hardware.turns import Turns
from robocomp_dsl.runtime import ServedPort

Turn = AbstractContextManager[Any]


class Port:
    """One port: an attribute for each operation of its interface, made when it is first called."""

    def __init__(self, servant: Servant, turn: Turn) -> None:
        self._servant = servant
        self._turn = turn
        self._look = turn.quiet if isinstance(turn, Turns) else turn

    def current(self, operation: str) -> list[Any]:
        """The answer of an operation, to be published; none where its device has been removed."""
        try:
            with self._look:
                return [getattr(self._servant, operation)()]
        except DeviceGone:
            return []

    def news(self) -> list[tuple[Any, ...]]:
        """What there is to publish since the last time, each as the inputs of the topic."""
        told = self.current("news")
        return told[0] if told else []

    def __getattr__(self, operation: str) -> Callable[..., Any]:
        answer = getattr(self._servant, operation)
        told, turn = self._servant.told, self._turn

        def call(*given: Any) -> Any:
            try:
                with turn:
                    return answer(*given)
            except HardwareError as error:
                raise told(operation, error) from None

        self.__dict__[operation] = call
        return call


class _Always:
    """The turn of servants that look after themselves."""

    def __enter__(self) -> None:
        pass

    def __exit__(self, *_: object) -> None:
        pass


def serve(
    ports: Iterable[ServedPort],
    chosen: Mapping[str, Sequence[str]],
    devices: Mapping[str, Any],
    turn: Turn,
    in_step: Callable[[], bool] = bool,
) -> dict[str, Port]:
    """The ports by their names. `chosen` lists the devices of each, `turn` guards them all.

    `in_step` tells whether nothing may depend on how long something takes.
    """
    made = {}
    for port in ports:
        servant = SERVANTS[port.interface.name](
            port.interface, port.name, tuple(chosen[port.name]), devices
        )
        servant.in_step = in_step
        made[port.name] = Port(servant, turn if servant.TAKES_TURNS else _Always())
    return made
