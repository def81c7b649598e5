"""What the parts of `InnerModel` share: the nodes, their lock, and the conversion of arguments."""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import wraps
from typing import Any, ParamSpec, Protocol, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robocomp_dsl.hardware.devices.errors import HardwareError
from robocomp_dsl.innermodel.errors import InnerModelError
from robocomp_dsl.innermodel.node_tree import NodeTree

Floats: TypeAlias = NDArray[np.float64]
Parameters = ParamSpec("Parameters")
Result = TypeVar("Result")


class HasId(Protocol):
    """A node, or the handle of a joint."""

    @property
    def id(self) -> str:
        """The id."""


NodeOrId: TypeAlias = str | HasId


class SharedState:
    """The nodes of an `InnerModel` and their lock, which every method takes.

    `lock` is public and reentrant: `with model.lock:` makes several calls one step for all other
    threads.
    """

    lock: threading.RLock
    _tree: NodeTree

    def _frame(self, id: str) -> str:
        """The frame where the node `id` is seen."""
        try:
            return self._tree.frames[id]
        except (KeyError, TypeError):
            raise self._tree.unknown(id) from None


def locked(method: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """A method of `SharedState` that runs under its lock; raises `InnerModelError` only."""

    @wraps(method)
    def call(*arguments: Parameters.args, **named: Parameters.kwargs) -> Result:
        state: Any = arguments[0]
        with state.lock:
            try:
                return method(*arguments, **named)
            except HardwareError as error:
                raise InnerModelError(str(error)) from None

    return call


def id_of(node: NodeOrId) -> str:
    """The id of a node that is given by its id or itself."""
    return node if isinstance(node, str) else node.id


def vector(values: ArrayLike, what: str, *lengths: int) -> Floats:
    """The values as an array of one of these lengths, all finite. Raises `InnerModelError`."""
    try:
        array = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise InnerModelError(f"{what} consists of numbers, not {values!r:.80}") from None
    if array.ndim != 1 or len(array) not in lengths:
        expected = " or ".join(map(str, lengths))
        raise InnerModelError(f"{what} has {expected} numbers, not the shape {array.shape}")
    return array


def number(value: object, what: str) -> float:
    """The value as a finite float. Raises `InnerModelError`."""
    try:
        converted = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise InnerModelError(f"`{what}` is a number, not {value!r:.80}") from None
    if not np.isfinite(converted):
        raise InnerModelError(f"`{what}` is {converted}, it must be a finite number")
    return converted
