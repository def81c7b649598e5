"""IDSL types in Python: what they are called, which schema they have, what their zero value is.

In: the types that a component can meet. Out: `PythonTypes`, which answers for each of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import layout, names
from robocomp_dsl.generate.layout import Item
from robocomp_dsl.generate.literals import python_value
from robocomp_dsl.model.interface import Module, Operation
from robocomp_dsl.model.types import (
    BOOL,
    BYTE,
    DOUBLE,
    FLOAT,
    INT,
    LONG,
    SHORT,
    STRING,
    Declaration,
    Dictionary,
    Enum,
    Enumerator,
    ExceptionType,
    Literal,
    Primitive,
    Sequence,
    Struct,
    Type,
    is_fixed,
)
from robocomp_dsl.record import Value

_ANNOTATION = {BOOL: "bool", STRING: "str", FLOAT: "float", DOUBLE: "float"}  # others: int
_ZERO = {BOOL: "False", STRING: '""', FLOAT: "0.0", DOUBLE: "0.0"}  # others: 0


class NumpyArray(Value):
    """The annotation of an array and the type of its elements."""

    alias: str
    dtype: str


_NUMPY = {
    BOOL: NumpyArray("rt.BoolArray", "np.bool_"),
    BYTE: NumpyArray("rt.UInt8Array", "np.uint8"),
    SHORT: NumpyArray("rt.Int16Array", "np.int16"),
    INT: NumpyArray("rt.Int32Array", "np.int32"),
    LONG: NumpyArray("rt.Int64Array", "np.int64"),
    FLOAT: NumpyArray("rt.Float32Array", "np.float32"),
    DOUBLE: NumpyArray("rt.Float64Array", "np.float64"),
}


class Zero(Value):
    """The value of a field that nobody gave; a `fresh` one must be made anew each time."""

    text: str
    fresh: bool = False


class PythonTypes:
    """The types of some modules, named."""

    def __init__(self, modules: Iterable[Module]) -> None:
        found = [
            d
            for module in modules
            for d in module.declarations
            if isinstance(d, Struct | Enum | Sequence | Dictionary | ExceptionType)
        ]
        self.names, self.scope = names.of_declarations(found)
        self.ordered = tuple(_dependencies_first(found))
        self.hidden = frozenset(_hidden(found, self.names))
        self._enumerators = {
            one: name for d in found if isinstance(d, Enum) for one, name in _enumerator_names(d)
        }

    def enumerator(self, one: Enumerator) -> str:
        """Its name in Python."""
        return self._enumerators[one]

    def annotation(self, type_: Type) -> str:
        """How it is written behind a colon."""
        if isinstance(type_, Primitive):
            return _ANNOTATION.get(type_, "int")
        return self.names[type_]

    def schema(self, type_: Type) -> str:
        """The object that the codec reads."""
        if isinstance(type_, Primitive):
            return f"rt.{type_.name.upper()}"
        if isinstance(type_, Struct | Enum) or record_element(type_):
            return self.names[type_]
        return f"_{self.names[type_]}"

    def zero(self, type_: Type, default: Literal | None = None) -> Zero:
        """The value of a field of this type for which nobody gives one."""
        if isinstance(type_, Primitive):
            return Zero(_primitive(type_, default))
        if isinstance(type_, Enum):
            return Zero(self._first(type_, default))
        if isinstance(type_, Struct) or record_element(type_):
            return Zero(f"{self.names[type_]}()", fresh=True)
        if array := numpy_of(type_):
            return Zero(f"np.zeros(0, {array.dtype})", fresh=True)
        return Zero("{}" if isinstance(type_, Dictionary) else "[]", fresh=True)

    def _first(self, type_: Enum, default: Literal | None) -> str:
        """The default, else the enumerator 0, else the first one."""
        by_rank = sorted(type_.enumerators, key=lambda e: (e.name != default, e.value != 0))
        return f"{self.names[type_]}.{self._enumerators[by_rank[0]]}"

    def results(self, operation: Operation) -> tuple[tuple[str, Type], ...]:
        """What a call gives: the return value under the name "", then the `out` parameters."""
        returned = (("", operation.result),) if operation.result is not None else ()
        return (*returned, *((p.name, p.type) for p in operation.outputs))

    def returns(self, operation: Operation) -> Item:
        """The annotation of what a call gives."""
        given = [self.annotation(type_) for _, type_ in self.results(operation)]
        if len(given) > 1:
            return layout.subscript("tuple", *given)
        return given[0] if given else "None"

    def arguments(self, operation: Operation) -> list[tuple[str, str]]:
        """Name and annotation of each input."""
        called = names.unique([p.name for p in operation.inputs], names.ARGUMENTS)
        return [
            (name, self.annotation(p.type))
            for name, p in zip(called, operation.inputs, strict=True)
        ]


def _primitive(type_: Primitive, default: Literal | None) -> str:
    if default is None:
        return _ZERO.get(type_, "0")
    return python_value(float(default) if type_ in (FLOAT, DOUBLE) else default)


def numpy_of(type_: Type) -> NumpyArray | None:
    """The numpy array that a sequence of numbers or bools is; None for other types."""
    if isinstance(type_, Sequence) and isinstance(type_.element, Primitive):
        return _NUMPY.get(type_.element)
    return None


def column_of(type_: Type) -> str:
    """The annotation of one column of an array of records; that of an enum holds its ints."""
    return _NUMPY[type_ if isinstance(type_, Primitive) else INT].alias


def record_element(type_: Type) -> Struct | None:
    """The struct of a sequence that is one structured array, because its layout is fixed."""
    if (
        isinstance(type_, Sequence)
        and isinstance(type_.element, Struct)
        and is_fixed(type_.element)
    ):
        return type_.element
    return None


def field_names(one: Struct | ExceptionType) -> tuple[str, ...]:
    """The attributes of a struct or exception."""
    reserved = names.STRUCT_MEMBERS if isinstance(one, Struct) else names.ERROR_MEMBERS
    return names.unique([f.name for f in one.fields], reserved)


def _hidden(found: Iterable[Declaration], called: dict[Declaration, str]) -> Iterator[str]:
    """Names of types that a field of the same struct is called by, as in `Pose Pose;`."""
    for one in found:
        if isinstance(one, Struct | ExceptionType):
            needed = {called[f.type] for f in one.fields if isinstance(f.type, Declaration)}
            yield from needed & set(field_names(one))


def _enumerator_names(type_: Enum) -> Iterator[tuple[Enumerator, str]]:
    called = names.unique([e.name for e in type_.enumerators], names.ENUM_MEMBERS)
    return zip(type_.enumerators, called, strict=True)


def _mentioned(declaration: Declaration) -> Iterator[Type]:
    match declaration:
        case Struct() | ExceptionType():
            yield from (f.type for f in declaration.fields)
        case Sequence():
            yield declaration.element
        case Dictionary():
            yield from (declaration.key, declaration.value)


def _dependencies_first(declarations: Iterable[Declaration]) -> Iterator[Declaration]:
    """Each after what it mentions, else in the order given; the checks exclude cycles."""
    done: set[Declaration] = set()

    def visit(one: Declaration) -> Iterator[Declaration]:
        if one in done:
            return
        done.add(one)
        for type_ in _mentioned(one):
            if isinstance(type_, Declaration):
                yield from visit(type_)
        yield one

    for one in declarations:
        yield from visit(one)
