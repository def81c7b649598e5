"""What every node of a tree is: frozen, compared by value, and cheap.

In: classes with annotated fields. Out: the same with slots and a constructor. `dataclass` would do,
but takes four times as long to make a class and twice as long to make an instance; trees have some
forty classes that every start of a command waits for, and thousands of instances that an editor
waits for at every key.
"""

from __future__ import annotations

from typing import Any, NoReturn, dataclass_transform

from robocomp_dsl.source import Span


@dataclass_transform(frozen_default=True)
class NodeType(type):
    """Makes the fields of a class body into slots and parameters of the constructor, in order."""

    defaults: dict[str, Any]

    def __new__(
        cls, name: str, bases: tuple[type, ...], body: dict[str, Any], **extra: Any
    ) -> NodeType:
        """The class called `name`; its fields follow those of its base."""
        own = tuple(body.get("__annotations__", ()))
        defaults = {} if not bases else dict(bases[0].defaults)  # type: ignore[attr-defined]
        defaults |= {field: body.pop(field) for field in own if field in body}
        inherited: tuple[str, ...] = bases[0].__match_args__ if bases else ()  # type: ignore[attr-defined]
        body["__slots__"] = own
        body["__match_args__"] = inherited + own
        made = super().__new__(cls, name, bases, body, **extra)
        made.defaults = defaults
        made.__init__ = _constructor(made, inherited + own, defaults)  # type: ignore[misc]
        return made


def _constructor(cls: type, fields: tuple[str, ...], defaults: dict[str, Any]) -> Any:
    """`__init__` with the fields as parameters; setters of slots work on frozen instances, too."""
    known = {f"default_{field}": value for field, value in defaults.items()}
    known |= {f"set_{field}": getattr(cls, field).__set__ for field in fields}
    parameters = [f"{field}=default_{field}" if field in defaults else field for field in fields]
    lines = [f"    set_{field}(self, {field})" for field in fields]
    code = "\n".join([f"def __init__(self, {', '.join(parameters)}):", *lines])
    exec(code, known)  # noqa: S102 - of field names only
    return known["__init__"]


class Node(metaclass=NodeType):
    """Something in a file; `span` runs from its first to its last character."""

    span: Span

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"{type(self).__name__} is frozen")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"{type(self).__name__} is frozen")

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and self._values() == other._values()

    def __hash__(self) -> int:
        return hash(self._values())

    def __repr__(self) -> str:
        fields: tuple[str, ...] = type(self).__match_args__
        shown = (f"{field}={getattr(self, field)!r}" for field in fields[1:])
        return f"{type(self).__name__}({', '.join(shown)})"

    def _values(self) -> tuple[object, ...]:
        fields: tuple[str, ...] = type(self).__match_args__
        return tuple(getattr(self, field) for field in fields)
