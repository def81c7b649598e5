"""Frozen classes of data that cost nothing until they are used.

In: classes with annotated fields. Out: the same with slots, and a constructor that is compiled for
the first instance. `dataclass` would do, but compiles five methods for every class, which takes
0.7 ms, and a start of a command would wait for seventy of them; an instance takes twice as long,
too, and trees have thousands. Where nobody waits, and for what changes, `dataclass` is right.
"""

from __future__ import annotations

from collections.abc import Callable
from operator import attrgetter
from typing import Any, NoReturn, Self, dataclass_transform


@dataclass_transform(frozen_default=True)
class RecordType(type):
    """Makes the fields of a class body into slots and parameters of the constructor, in order.

    `content` gives the values of all fields of an instance.
    """

    __match_args__: tuple[str, ...]
    defaults: dict[str, Any]
    content: Callable[[object], object]

    def __new__(
        cls, name: str, bases: tuple[type, ...], body: dict[str, Any], **extra: Any
    ) -> RecordType:
        """The class called `name`; its fields follow those of its first base."""
        own = tuple(body.get("__annotations__", ()))
        base = bases[0] if bases and isinstance(bases[0], RecordType) else None
        fields = (base.__match_args__ if base else ()) + own
        defaults = dict(base.defaults) if base else {}
        defaults |= {field: body.pop(field) for field in own if field in body}
        body["__slots__"] = own + body.get("__slots__", ())
        body["__match_args__"] = fields
        made = super().__new__(cls, name, bases, body, **extra)
        made.defaults = defaults
        made.__init__ = _compiled_when_called(made)  # type: ignore[misc]
        if fields:
            made.content = attrgetter(*fields)
        return made


def _compiled_when_called(made: Any) -> Any:
    def compiled(self: object, *values: object, **named: object) -> None:
        made.__init__ = _constructor(made)
        made.__init__(self, *values, **named)

    return compiled


def _constructor(cls: RecordType) -> Any:
    """`__init__` with the fields as parameters; setters of slots work on frozen instances, too."""
    fields = cls.__match_args__
    known = {f"default_{field}": value for field, value in cls.defaults.items()}
    known |= {f"set_{field}": getattr(cls, field).__set__ for field in fields}
    parameters = [f"{f}=default_{f}" if f in cls.defaults else f for f in fields]
    lines = [f"    set_{field}(self, {field})" for field in fields] or ["    pass"]
    code = "\n".join([f"def __init__({', '.join(['self', *parameters])}):", *lines])
    exec(code, known)  # noqa: S102 - of field names only
    return known["__init__"]


class Record(metaclass=RecordType):
    """Data that stays as it was made; two of them are only equal if they are one."""

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"{type(self).__name__} is frozen")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"{type(self).__name__} is frozen")

    def __repr__(self) -> str:
        shown = (f"{field}={getattr(self, field)!r}" for field in type(self).__match_args__)
        return f"{type(self).__name__}({', '.join(shown)})"

    def replaced(self, **changes: Any) -> Self:
        """The same with some fields changed."""
        kept = {f: getattr(self, f) for f in type(self).__match_args__}
        return type(self)(**kept | changes)


class Value(Record):
    """A record that is compared by its fields."""

    def __eq__(self, other: object) -> bool:
        kind = type(self)
        return type(other) is kind and kind.content(self) == kind.content(other)

    def __hash__(self) -> int:
        return hash(type(self).content(self))
