"""Immutable record classes with lazily compiled constructors, for a short start-up time.

In: classes with annotated fields. Out: the same classes with slots; the constructor is compiled
when the first instance is created. A `dataclass` compiles five methods per class, which takes
0.7 ms, and a command loads about seventy classes; its instances also take twice as long to create,
and trees have thousands. Use `dataclass` for mutable data and where start-up time does not matter.
"""

from __future__ import annotations

from collections.abc import Callable
from operator import attrgetter
from typing import Any, NoReturn, Self, dataclass_transform


@dataclass_transform(frozen_default=True)
class RecordType(type):
    """Turns the annotated fields of a class into slots and constructor parameters, in order.

    `astuple` returns the values of all fields of an instance.
    """

    __match_args__: tuple[str, ...]
    defaults: dict[str, Any]
    astuple: Callable[[object], object]

    def __new__(
        cls, name: str, bases: tuple[type, ...], body: dict[str, Any], **extra: Any
    ) -> RecordType:
        """Create the class `name`; its own fields follow those of its first base."""
        own = tuple(body.get("__annotations__", ()))
        base = bases[0] if bases and isinstance(bases[0], RecordType) else None
        fields = (base.__match_args__ if base else ()) + own
        defaults = dict(base.defaults) if base else {}
        defaults |= {field: body.pop(field) for field in own if field in body}
        body["__slots__"] = own + body.get("__slots__", ())
        body["__match_args__"] = fields
        record_class = super().__new__(cls, name, bases, body, **extra)
        record_class.defaults = defaults
        record_class.__init__ = _lazy_constructor(record_class)  # type: ignore[misc]
        if fields:
            record_class.astuple = attrgetter(*fields)
        return record_class


def _lazy_constructor(record_class: Any) -> Any:
    def compile_and_call(self: object, *values: object, **named: object) -> None:
        record_class.__init__ = _constructor(record_class)
        record_class.__init__(self, *values, **named)

    return compile_and_call


def _constructor(cls: RecordType) -> Any:
    """`__init__` with the fields as parameters; it sets frozen fields through their slots."""
    fields = cls.__match_args__
    namespace = {f"default_{field}": value for field, value in cls.defaults.items()}
    namespace |= {f"set_{field}": getattr(cls, field).__set__ for field in fields}
    parameters = [f"{f}=default_{f}" if f in cls.defaults else f for f in fields]
    lines = [f"    set_{field}(self, {field})" for field in fields] or ["    pass"]
    code = "\n".join([f"def __init__({', '.join(['self', *parameters])}):", *lines])
    exec(code, namespace)  # noqa: S102 - contains field names only
    return namespace["__init__"]


class Record(metaclass=RecordType):
    """Immutable data; two records are equal only if they are the same object."""

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"{type(self).__name__} is frozen")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"{type(self).__name__} is frozen")

    def __repr__(self) -> str:
        fields = (f"{field}={getattr(self, field)!r}" for field in type(self).__match_args__)
        return f"{type(self).__name__}({', '.join(fields)})"

    def replace(self, **changes: Any) -> Self:
        """A copy with some fields changed."""
        values = {f: getattr(self, f) for f in type(self).__match_args__}
        return type(self)(**values | changes)


class ValueRecord(Record):
    """A record that is compared by its class and fields."""

    def __eq__(self, other: object) -> bool:
        kind = type(self)
        return type(other) is kind and kind.astuple(self) == kind.astuple(other)

    def __hash__(self) -> int:
        return hash(type(self).astuple(self))
