"""Records: the classes behind IDSL structs and exceptions.

In: `_fields_`, which generated subclasses declare. Out: comparison, hash, repr, copy and pickle by
value, numpy arrays included.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, ClassVar

from robocomp_dsl.runtime.values import hashed, same, shown

if TYPE_CHECKING:
    from robocomp_dsl.runtime.schema import Type


class Record:
    """A value with named fields.

    A subclass declares `_fields_`, (wire name, type) pairs in the order of the wire and of its
    `__init__`, and in `__slots__` an attribute for each, in any order. An attribute is called as on
    the wire, with underscores behind where that is a word of Python (`None` → `None_`); a subclass
    that calls one otherwise gives `_names_` itself.
    """

    __slots__ = ()
    _fields_: ClassVar[tuple[tuple[str, Type], ...]] = ()
    _names_: ClassVar[tuple[str, ...]] = ()  # the attributes, in the order of `_fields_`
    _plain_: ClassVar[type[Record]]  # the declared class, also of a row of an array

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        if "_fields_" in cls.__dict__:
            slots: str | Iterable[str] = cls.__dict__.get("__slots__", ())
            attributes = {slots} if isinstance(slots, str) else set(slots)
            if "_names_" not in cls.__dict__:
                cls._names_ = _attributes([name for name, _ in cls._fields_], attributes)
            cls._plain_ = cls
            if set(cls._names_) != attributes:
                raise TypeError(f"{cls.__name__}: __slots__ and _fields_ do not agree")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Record) or self._plain_ is not other._plain_:
            return NotImplemented
        return all(same(getattr(self, n), getattr(other, n)) for n in self._names_)

    def __hash__(self) -> int:
        """By value, so that structs can be keys of dictionaries; do not change one that is."""
        return hash((self._plain_, *(hashed(v) for v in self._astuple())))

    def __repr__(self) -> str:
        fields = zip(self._names_, self._astuple(), strict=True)
        text = ", ".join(f"{name}={shown(value)}" for name, value in fields)
        return f"{self._plain_.__name__}({text})"

    def __reduce__(self) -> tuple[Any, ...]:
        """Copied and pickled as its fields; a row of an array becomes a value of its own."""
        return self._plain_, self._astuple()

    def _astuple(self) -> tuple[Any, ...]:
        return tuple(getattr(self, name) for name in self._names_)


def _attributes(names: list[str], slots: set[str]) -> tuple[str, ...]:
    """The attribute of each field; `slots` may have been sorted by a linter."""
    free = slots.difference(names)
    result = []
    for name in names:
        attribute = name
        while attribute not in free and name not in slots and len(attribute) <= len(name) + 2:
            attribute += "_"
        free.discard(attribute)
        result.append(attribute)
    return tuple(result)


class Struct(Record):
    """Base of the structs that an IDSL file declares."""

    __slots__ = ()
