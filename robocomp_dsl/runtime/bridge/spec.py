"""Data of a bridge: what generated code states and `RunningBridge` reads. No I/O.

Places in the text of the bridge are `file:line`, as messages show them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

Policy: TypeAlias = Literal["latest", "all", "synchronised"]


@dataclass(frozen=True, slots=True)
class InputSpec:
    """An input: the subscribed port and its operation.

    `stamp` returns the time stamp of a message in ns; None: the time stamp of the middleware, else
    the time of arrival. `needs_stamp`: a synchronised hub or an output uses it. `check` raises
    `DoesNotFit` for a message that the declared type does not permit.
    """

    name: str
    port: str
    operation: str
    place: str
    stamp: Callable[[Any], int] | None = None
    needs_stamp: bool = False
    check: Callable[[Any], object] | None = None


@dataclass(frozen=True, slots=True)
class HubSpec:
    """A hub over some inputs. `tolerance` and `max_age` in s; `max_age` 0: no limit.

    `is_passive`: it does not cause outputs to be sent, they only read it.
    """

    name: str
    inputs: tuple[str, ...]
    place: str
    policy: Policy = "latest"
    tolerance: float = 0.0
    max_age: float = 0.0
    is_passive: bool = False


@dataclass(frozen=True, slots=True)
class OutputSpec:
    """An output: the published port and its operation.

    `build` gets a `MessageContext`, the worker, and for each hub the tuple of the values of its
    messages; it returns the tuple of arguments to publish. `rate` in Hz, 0: a message whenever a
    hub is ready anew. `places` has the place of each assigned field by its path, "" is that of the
    output.
    """

    name: str
    port: str
    operation: str
    hubs: tuple[str, ...]
    build: Callable[..., tuple[Any, ...]]
    places: Mapping[str, str] = field(default_factory=dict)
    rate: float = 0.0

    @property
    def place(self) -> str:
        """The place of the output."""
        return self.places.get("", "")


@dataclass(frozen=True, slots=True)
class ServiceSpec:
    """A served operation. `answer` gets a `MessageContext`, the worker and the arguments.

    `places` are as in `OutputSpec`.
    """

    name: str
    port: str
    operation: str
    answer: Callable[..., Any]
    places: Mapping[str, str] = field(default_factory=dict)

    @property
    def place(self) -> str:
        """The place of the service."""
        return self.places.get("", "")


@dataclass(frozen=True, slots=True)
class CommandSpec:
    """A command of an action; `build` gets a `MessageContext`, the worker and the goal.

    `is_on_cancel`: it is sent if a goal is cancelled or takes too long. `places` are as in
    `OutputSpec`.
    """

    name: str
    port: str
    operation: str
    build: Callable[..., tuple[Any, ...]]
    places: Mapping[str, str] = field(default_factory=dict)
    is_on_cancel: bool = False


@dataclass(frozen=True, slots=True)
class ActionTopicSpec:
    """A topic that an action publishes; `message` is the class of its messages."""

    port: str
    operation: str
    message: Callable[[], Any]


@dataclass(frozen=True, slots=True)
class ActionSpec:
    """An action server. `goal`, `cancel` and `states` are inputs.

    The functions get a `MessageContext`, the worker, the goal, and the newest message of each
    state. `timeout` in s, 0: none. `places` are as in `OutputSpec`.
    """

    name: str
    place: str
    goal: str
    cancel: str
    states: tuple[str, ...]
    status: ActionTopicSpec
    feedback: ActionTopicSpec
    result: ActionTopicSpec
    commands: tuple[CommandSpec, ...]
    build_feedback: Callable[..., Any]
    build_result: Callable[..., Any]
    succeeds: Callable[..., bool]
    aborts: Callable[..., bool] | None = None
    timeout: float = 0.0
    places: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class BridgeSpec:
    """All of a bridge; `source` is the file it was generated from."""

    source: str
    inputs: tuple[InputSpec, ...] = ()
    hubs: tuple[HubSpec, ...] = ()
    outputs: tuple[OutputSpec, ...] = ()
    services: tuple[ServiceSpec, ...] = ()
    actions: tuple[ActionSpec, ...] = ()
