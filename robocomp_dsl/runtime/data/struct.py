"""Structs: the base class of the structs and exceptions of an IDSL file.

In: annotated class attributes. Out: slots, a constructor that is compiled for the first object,
and comparison, hash, repr, copy and pickle by value, including numpy arrays.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from typing import Any, ClassVar, dataclass_transform

import numpy as np

from robocomp_dsl.runtime.data.schema import (
    Array,
    Dictionary,
    Enum,
    Fields,
    Primitive,
    Sequence,
    StructBase,
    Type,
    schema_of,
)
from robocomp_dsl.runtime.data.values import hashed, same, shown

_EMPTY = object()


class _Items(tuple[Any, ...]):
    """The elements of a default that is not empty."""

    __slots__ = ()


def default(*items: Any) -> Any:
    """The default of a field of type list, dict, array or struct.

    Every new struct gets its own object: empty, zeros in a fixed array, or with `items`.
    """
    return _Items(items) if items else _EMPTY


class StructMeta(type):
    """Converts the annotations of a class to slots, `_fields_` and `_names_`."""

    def __new__(
        cls,
        name: str,
        bases: tuple[type, ...],
        namespace: dict[str, Any],
        *,
        type_id: str = "",
        definition: str = "",
        rename: Mapping[str, str] | None = None,
        units: Mapping[str, str] | None = None,
    ) -> StructMeta:
        """A new class. `rename` maps attributes to field names of the IDSL file if they differ.

        `units` maps field names of the IDSL file to their units.
        """
        if "_fields_" in namespace or any(hasattr(base, "_plain_") for base in bases):
            return super().__new__(cls, name, bases, namespace)  # a base, or a user's subclass
        annotations = _annotations(name, namespace)
        names, wire = tuple(annotations), rename or {}
        namespace |= {
            "_type_id_": type_id,
            "_definition_": definition,
            "_units_": units or {},
            "_names_": names,
            "_fields_": tuple((wire.get(n, n), schema_of(t)) for n, t in annotations.items()),
            "_defaults_": {n: namespace.pop(n) for n in names if n in namespace},
            "__slots__": names,
            "__match_args__": names,
        }
        class_ = super().__new__(cls, name, bases, namespace)
        class_._plain_ = class_  # type: ignore[attr-defined]
        return class_


def _annotations(name: str, namespace: dict[str, Any]) -> dict[str, object]:
    """The annotations of a class body, evaluated."""
    found: dict[str, Any] = namespace.get("__annotations__", {})
    if sys.version_info >= (3, 14) and not found:
        import annotationlib  # noqa: PLC0415 - new in Python 3.14

        if annotate := annotationlib.get_annotate_from_class_namespace(namespace):
            values = annotationlib.Format.VALUE
            found = annotationlib.call_annotate_function(annotate, values)
    if not any(isinstance(annotation, str) for annotation in found.values()):
        return found
    scope = vars(sys.modules[namespace["__module__"]])
    try:  # a module with `from __future__ import annotations`
        return {key: eval(annotation, scope) for key, annotation in found.items()}  # noqa: S307 - its own text
    except NameError as error:
        raise TypeError(f"{name}: {error}; a field's type must be defined above") from None


@dataclass_transform()
class Struct(StructBase, metaclass=StructMeta):
    """Base of the structs that an IDSL file declares: a value with named fields.

    A subclass annotates one attribute per field, in wire order:

        class Beam(rt.Struct):
            angle: rt.Float = 0.0
            dist: rt.Float = 0.0

    The constructor requires attributes without a default; the default of a list, dict, array or
    struct is `rt.default()`. `class Beam(rt.Struct, rename={"None_": "None"})` states the names of
    fields that differ between the IDSL file and Python. `type_id="RoboCompLaser::Beam"` is the name
    of the type in its IDSL file, for middlewares that send names of types; the type hash excludes
    it. `definition` is the text of a ROS definition with constants, which the md5 of ROS 1 covers.
    `units={"x": "mm"}` has the units of fields, which the type hash covers.
    """

    __slots__ = ()
    _type_id_: ClassVar[str] = ""
    _definition_: ClassVar[str] = ""
    _units_: ClassVar[Mapping[str, str]] = {}
    _fields_: ClassVar[Fields] = ()
    _names_: ClassVar[tuple[str, ...]] = ()
    _defaults_: ClassVar[dict[str, Any]] = {}
    _plain_: ClassVar[type[Struct]]  # the declared class, also of an array element

    def __init__(self, *args: Any, **fields: Any) -> None:
        # Compiled and replaced on first use: programs construct few of the types they import.
        cls = self._plain_
        cls.__init__ = init = _constructor(cls)  # type: ignore[method-assign]
        init(self, *args, **fields)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Struct) or self._plain_ is not other._plain_:
            return NotImplemented
        return all(same(getattr(self, n), getattr(other, n)) for n in self._names_)

    def __hash__(self) -> int:
        """By value, so that structs can be dictionary keys; do not change such a struct."""
        return hash((self._plain_, *(hashed(v) for v in self._astuple())))

    def __repr__(self) -> str:
        fields = zip(self._names_, self._astuple(), strict=True)
        text = ", ".join(f"{name}={shown(value)}" for name, value in fields)
        return f"{self._plain_.__name__}({text})"

    def __reduce__(self) -> tuple[Any, ...]:
        """Copied and pickled by fields; an array element becomes an independent value."""
        return self._plain_, self._astuple()

    def _astuple(self) -> tuple[Any, ...]:
        return tuple(getattr(self, name) for name in self._names_)


def _constructor(cls: type[Struct]) -> Callable[..., None]:
    """`__init__` with one parameter per field, as fast as hand-written code."""
    scope: dict[str, Any] = {"_zeros": np.zeros}
    parameters, body = ["self"], []
    for position, (name, (_, type_)) in enumerate(zip(cls._names_, cls._fields_, strict=True)):
        parameter, value = _parameter(cls, name, type_, f"_{position}", scope)
        parameters.append(parameter)
        body.append(f"    self.{name} = {value}\n")
    source = f"def __init__({', '.join(parameters)}):\n{''.join(body) or '    pass'}"
    exec(compile(source, f"<{cls.__name__}.__init__>", "exec"), scope)  # noqa: S102 - made here
    init: Callable[..., None] = scope["__init__"]
    init.__qualname__ = f"{cls.__qualname__}.__init__"
    init.__module__ = cls.__module__
    return init


def _parameter(
    cls: type[Struct], name: str, type_: Type, constant: str, scope: dict[str, Any]
) -> tuple[str, str]:
    """The parameter of a field and the value to store; constants go into `scope`."""
    if name not in cls._defaults_:
        return name, name
    value = cls._defaults_[name]
    is_plain = isinstance(type_, Primitive) or (isinstance(type_, type) and issubclass(type_, Enum))
    if is_plain is (value is _EMPTY or isinstance(value, _Items)):
        right = "a value of its type" if is_plain else "rt.default()"
        raise TypeError(f"{cls.__name__}.{name}: its default must be {right}")
    if is_plain:
        scope[constant] = value
        return f"{name}={constant}", name
    if isinstance(value, _Items):
        fresh = _filled(type_, value, constant, scope)
    else:
        fresh = _empty(type_, constant, scope)
    return f"{name}=None", f"{fresh} if {name} is None else {name}"


def _filled(type_: Type, items: _Items, constant: str, scope: dict[str, Any]) -> str:
    """An expression for a new array or list with `items`."""
    if isinstance(type_, Array):
        scope[constant] = np.array(items, type_.element.dtype)
        return f"{constant}.copy()"
    scope[constant] = items
    return f"list({constant})"


def _empty(type_: Type, constant: str, scope: dict[str, Any]) -> str:
    """An expression for a new empty object of `type_`."""
    if isinstance(type_, Sequence):
        return _empty_list(type_, constant, scope)
    if isinstance(type_, Dictionary):
        return "{}"
    if isinstance(type_, Array):
        scope[constant] = type_.element.dtype
        return f"_zeros({type_.size}, {constant})"
    scope[constant] = type_
    return f"{constant}()"


def _empty_list(type_: Sequence, constant: str, scope: dict[str, Any]) -> str:
    """An expression for a new list of as many elements as `type_` must have."""
    if not type_.size:
        return "[]"
    if isinstance(type_.element, Primitive):
        return f'[""] * {type_.size}'
    if isinstance(type_.element, type) and issubclass(type_.element, Enum):
        scope[constant] = _first(type_.element)
        return f"[{constant}] * {type_.size}"
    return f"[{_empty(type_.element, constant, scope)} for _ in range({type_.size})]"


def _first(type_: type[Enum]) -> Enum:
    """The enumerator 0, else the first."""
    return next((member for member in type_ if not member), next(iter(type_)))
