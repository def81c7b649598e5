"""The base of servants: their types and devices, and the mapping of errors to exceptions.

In: an interface as declared by generated code, and the devices of the port. Out: the base classes;
the methods of their subclasses are the operations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, ClassVar

from robocomp_dsl.hardware.devices.errors import DeviceGone, HardwareError
from robocomp_dsl.runtime import types as rt

_MODULE = "RoboComp"


class InterfaceTypes:
    """The types of an interface, as attributes with their IDSL names.

    Generated classes of the same name in two modules have their module as prefix
    (`RoboCompLaser_TData`); the attributes do not.
    """

    def __init__(self, interface: rt.Interface) -> None:
        seen: dict[Any, None] = {}
        for operation in interface.operations:
            for type_ in (
                *(t for _, t in (*operation.inputs, *operation.outputs)),
                *operation.throws,
            ):
                _collect_types(type_, seen)
        vars(self).update({_plain_name(operation): operation for operation in seen})

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"the interface has no type `{name}`")


def _collect_types(type_: Any, seen: dict[Any, None]) -> None:
    if isinstance(type_, type) and type_ not in seen:
        seen[type_] = None
    for inner in _member_types(type_):
        if not isinstance(inner, type) or inner not in seen:
            _collect_types(inner, seen)


def _member_types(type_: Any) -> Iterator[Any]:
    if isinstance(type_, rt.Sequence):
        yield type_.element
    elif isinstance(type_, rt.Dictionary):
        yield from (type_.key, type_.value)
    elif isinstance(type_, type):
        yield from (inner for _, inner in getattr(type_, "_fields_", ()))
        if element := getattr(type_, "_element_", None):
            yield element


def _plain_name(class_: type) -> str:
    name = class_.__name__
    if name.startswith(_MODULE) and "_" in name:
        name = name.partition("_")[2]
    return name.removesuffix("_")


class Servant:
    """One port. `ids` are its devices, in order; they are looked up in `devices` at every call."""

    NEEDS_LOCK: ClassVar[bool] = True
    """Whether the world must be paused during a call."""

    FAILURES: ClassVar[tuple[tuple[type[HardwareError], str], ...]] = (
        (HardwareError, "HardwareFailedException"),
    )
    """Error classes and the exceptions that they are mapped to, specific ones first."""

    def __init__(
        self, interface: rt.Interface, port: str, ids: tuple[str, ...], devices: Mapping[str, Any]
    ) -> None:
        self.types = InterfaceTypes(interface)
        self.port = port
        self.ids = ids
        self.on_deployment_clock: Callable[[], bool] = bool
        self._devices = devices
        self._throws = {operation.name: operation.throws for operation in interface.operations}

    def device(self, id: str = "") -> Any:
        """The device `id`, or the first. Raises `DeviceGone`."""
        key = id or self.ids[0]
        try:
            return self._devices[key]
        except KeyError:
            raise DeviceGone(f"`{key}` has been removed from the world") from None

    def board_device(self) -> Any:
        """The board of all joints. Raises `DeviceGone` if none are left."""
        for device in self._devices.values():
            if hasattr(device, "board"):
                return device
        raise DeviceGone("there are no joints any more")

    def to_idl_error(self, operation: str, error: HardwareError) -> Exception:
        """The exception for the caller of `operation`: a declared one if possible."""
        for kind, name in self.FAILURES:
            for declared in self._throws.get(operation, ()):
                if isinstance(error, kind) and _plain_name(declared) == name:
                    exception: Exception = self.declared_error(declared, error)
                    return exception
        return error

    def declared_error(self, declared: type[Any], error: HardwareError) -> Exception:
        """The exception that the interface declares, with its fields."""
        exception: Exception = declared(what=str(error))
        return exception
