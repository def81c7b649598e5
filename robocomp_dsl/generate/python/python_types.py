"""IDSL types in Python: their names, annotations and default values.

In: the types that a component uses. Out: `PythonTypes`, with one method per question.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import names
from robocomp_dsl.generate.literals import python_value
from robocomp_dsl.model.interface import Module, Operation
from robocomp_dsl.model.types import (
    BOOL,
    BYTE,
    DOUBLE,
    FLOAT,
    INT,
    INT8,
    LONG,
    OCTET,
    SHORT,
    STRING,
    UINT16,
    UINT32,
    UINT64,
    Declaration,
    Dictionary,
    Enum,
    Enumerator,
    ExceptionType,
    Field,
    Literal,
    Primitive,
    Sequence,
    Struct,
    Type,
    is_fixed,
)
from robocomp_dsl.record import ValueRecord

_ANNOTATION = {BOOL: "bool", STRING: "str", FLOAT: "float", DOUBLE: "float"}  # others: int
_UNSIGNED = {UINT16: "rt.UInt16", UINT32: "rt.UInt32", UINT64: "rt.UInt64"}
_ZERO: dict[Type, str] = {BOOL: "False", STRING: '""', FLOAT: "0.0", DOUBLE: "0.0"}  # others: 0


class NumpyArray(ValueRecord):
    """The annotation of an array, of a column of structs, and the type of the elements."""

    alias: str
    column: str
    dtype: str


NUMPY = {
    BOOL: NumpyArray("rt.BoolArray", "rt.BoolColumn", "np.bool_"),
    BYTE: NumpyArray("rt.UInt8Array", "rt.UInt8Column", "np.uint8"),
    SHORT: NumpyArray("rt.Int16Array", "rt.Int16Column", "np.int16"),
    INT: NumpyArray("rt.Int32Array", "rt.Int32Column", "np.int32"),
    LONG: NumpyArray("rt.Int64Array", "rt.Int64Column", "np.int64"),
    FLOAT: NumpyArray("rt.Float32Array", "rt.Float32Column", "np.float32"),
    DOUBLE: NumpyArray("rt.Float64Array", "rt.Float64Column", "np.float64"),
    INT8: NumpyArray("rt.Int8Array", "rt.Int8Column", "np.int8"),
    OCTET: NumpyArray("rt.OctetArray", "rt.OctetColumn", "np.uint8"),
    UINT16: NumpyArray("rt.UInt16Array", "rt.UInt16Column", "np.uint16"),
    UINT32: NumpyArray("rt.UInt32Array", "rt.UInt32Column", "np.uint32"),
    UINT64: NumpyArray("rt.UInt64Array", "rt.UInt64Column", "np.uint64"),
}


class Zero(ValueRecord):
    """The default of a field; a `fresh` default is created for each instance."""

    text: str
    fresh: bool = False


class PythonTypes:
    """The types of some modules with their Python names."""

    def __init__(self, modules: Iterable[Module]) -> None:
        found = [
            d
            for module in modules
            for d in module.declarations
            if isinstance(d, Struct | Enum | Sequence | Dictionary | ExceptionType)
        ]
        self._arrays = {a.element: a for a in _arrays_of_ros(found)}
        found = [*self._arrays.values(), *found]
        self.names, self.scope = names.of_declarations(found)
        self.ordered = tuple(_dependencies_first(found))
        self.hidden = frozenset(_hidden(found, self.names))
        self._enumerators = {
            declaration: name
            for d in found
            if isinstance(d, Enum)
            for declaration, name in _enumerator_names(d)
        }

    def enumerator(self, enumerator: Enumerator) -> str:
        """The Python name of a type."""
        return self._enumerators[enumerator]

    def annotation(self, type_: Type) -> str:
        """The annotation of a type after a colon."""
        if isinstance(type_, Primitive):
            return "str" if type_.is_text else _ANNOTATION.get(type_, "int")
        return self.names[type_]

    def declared(self, type_: Type, inside: Struct | ExceptionType | None = None) -> str:
        """The annotation in generated types and operations, which includes the wire type.

        In the struct `inside` a field with the name of its type hides the type.
        """
        if isinstance(type_, Primitive):
            return _declared_primitive(type_)
        if isinstance(type_, Sequence) and type_.is_anonymous:
            return self._declared_array(type_, inside)
        name = self.names[type_]
        return f"_{name}" if inside is not None and name in field_names(inside) else name

    def _declared_array(self, type_: Sequence, inside: Struct | ExceptionType | None) -> str:
        """The annotation of the array of a field."""
        if type_.element in self._arrays and not (type_.size or type_.bound):
            return self.declared(self._arrays[type_.element], inside)
        return self.list_or_array(type_, inside)

    def list_or_array(self, type_: Sequence, inside: Struct | ExceptionType | None = None) -> str:
        """The annotation of a sequence: a numpy array or a list, with its length or bound."""
        array = numpy_of(type_)
        plain = array.alias if array else f"list[{self.declared(type_.element, inside)}]"
        if type_.size:
            return f"Annotated[{plain}, rt.Length({type_.size})]"
        return f"Annotated[{plain}, rt.MaxLength({type_.bound})]" if type_.bound else plain

    def default(self, field: Field, inside: Struct | ExceptionType) -> str:
        """The default of a field in the struct `inside`."""
        if field.items and isinstance(field.type, Sequence):
            element = field.type.element
            return f"rt.default({', '.join(_primitive(element, item) for item in field.items)})"
        zero = self.zero(field.type, field.default)
        if zero.fresh:
            return "rt.default()"
        if isinstance(field.type, Enum):
            return f"{self.declared(field.type, inside)}.{zero.text.rpartition('.')[2]}"
        return zero.text

    def zero(self, type_: Type, default: Literal | None = None) -> Zero:
        """The default value of a field of this type."""
        if isinstance(type_, Primitive):
            return Zero(_primitive(type_, default))
        if isinstance(type_, Enum):
            return Zero(self._first(type_, default))
        if isinstance(type_, Sequence) and type_.is_anonymous:
            return Zero("[]", fresh=True)
        if isinstance(type_, Struct) or record_element(type_):
            return Zero(f"{self.names[type_]}()", fresh=True)
        if array := numpy_of(type_):
            return Zero(f"np.zeros(0, {array.dtype})", fresh=True)
        return Zero("{}" if isinstance(type_, Dictionary) else "[]", fresh=True)

    def _first(self, type_: Enum, default: Literal | None) -> str:
        """The default, else the enumerator with value 0, else the first enumerator."""
        by_rank = sorted(type_.enumerators, key=lambda e: (e.name != default, e.value != 0))
        return f"{self.names[type_]}.{self._enumerators[by_rank[0]]}"

    def results(self, operation: Operation) -> tuple[tuple[str, Type], ...]:
        """The results of a call: the return value with the name "", then the `out` parameters."""
        returned = (("", operation.result),) if operation.result is not None else ()
        return (*returned, *((p.name, p.type) for p in operation.outputs))

    def returns(self, operation: Operation) -> str:
        """The return annotation of a call."""
        annotations = [self.annotation(type_) for _, type_ in self.results(operation)]
        if len(annotations) > 1:
            return f"tuple[{', '.join(annotations)}]"
        return annotations[0] if annotations else "None"

    def arguments(self, operation: Operation) -> list[tuple[str, str]]:
        """Name and annotation of each input."""
        argument_names = names.unique([p.name for p in operation.inputs], names.ARGUMENTS)
        return [
            (name, self.annotation(p.type))
            for name, p in zip(argument_names, operation.inputs, strict=True)
        ]


def _declared_primitive(type_: Primitive) -> str:
    if type_.bound:
        return f"Annotated[rt.String, rt.MaxLength({type_.bound})]"
    return _UNSIGNED.get(type_, f"rt.{type_.name.capitalize()}")


def _primitive(type_: Type, default: Literal | None) -> str:
    if default is None:
        is_text = isinstance(type_, Primitive) and type_.is_text
        return '""' if is_text else _ZERO.get(type_, "0")
    return python_value(float(default) if type_ in (FLOAT, DOUBLE) else default)


def numpy_of(type_: Type) -> NumpyArray | None:
    """The numpy array of a sequence of numbers or bools; None for other types."""
    if isinstance(type_, Sequence) and isinstance(type_.element, Primitive):
        return NUMPY.get(type_.element)
    return None


def column_of(type_: Type) -> str:
    """The expression for one column of an array of structs; enum columns hold ints."""
    return NUMPY[type_ if isinstance(type_, Primitive) else INT].column


def record_element(type_: Type) -> Struct | None:
    """The struct of a sequence stored as a structured array, which needs a fixed layout."""
    if (
        isinstance(type_, Sequence)
        and not (type_.size or type_.bound)
        and isinstance(type_.element, Struct)
        and is_fixed(type_.element)
    ):
        return type_.element
    return None


def field_names(type_: Struct | ExceptionType) -> tuple[str, ...]:
    """The attributes of a struct or exception."""
    reserved = names.STRUCT_MEMBERS if isinstance(type_, Struct) else names.ERROR_MEMBERS
    return names.unique([f.name for f in type_.fields], reserved)


def _arrays_of_ros(found: Iterable[Declaration]) -> Iterator[Sequence]:
    """A named array for each struct of which ROS definitions have arrays of any length."""
    elements = {
        element: None
        for declaration in found
        if isinstance(declaration, Struct)
        for field in declaration.fields
        if isinstance(field.type, Sequence) and field.type.is_anonymous
        if (element := record_element(field.type))
    }
    for struct in elements:
        doc = f"A sequence of {struct.qualified}."
        yield Sequence(struct.module, f"{struct.name}Sequence", struct.span, doc, struct)


def _hidden(found: Iterable[Declaration], type_names: dict[Declaration, str]) -> Iterator[str]:
    """Types whose name is also a field of the same struct, as in `Pose Pose;`."""
    for declaration in found:
        if isinstance(declaration, Struct | ExceptionType):
            referenced = (_declared_in(f.type) for f in declaration.fields)
            needed = {type_names[type_] for type_ in referenced if type_ is not None}
            yield from needed & set(field_names(declaration))


def _declared_in(type_: Type) -> Declaration | None:
    """The declaration that the annotation of a field names."""
    if isinstance(type_, Sequence) and type_.is_anonymous:
        type_ = type_.element
    return None if isinstance(type_, Primitive) else type_


def _enumerator_names(type_: Enum) -> Iterator[tuple[Enumerator, str]]:
    enumerator_names = names.unique([e.name for e in type_.enumerators], names.ENUM_MEMBERS)
    return zip(type_.enumerators, enumerator_names, strict=True)


def _mentioned(declaration: Declaration) -> Iterator[Type]:
    match declaration:
        case Struct() | ExceptionType():
            yield from (f.type for f in declaration.fields)
        case Sequence():
            yield declaration.element
        case Dictionary():
            yield from (declaration.key, declaration.value)


def _dependencies_first(declarations: Iterable[Declaration]) -> Iterator[Declaration]:
    """Topological order, stable otherwise; the checks exclude cycles."""
    done: set[Declaration] = set()

    def visit(enumerator: Declaration) -> Iterator[Declaration]:
        if enumerator in done:
            return
        done.add(enumerator)
        for type_ in _mentioned(enumerator):
            if isinstance(type_, Declaration):
                yield from visit(type_)
        if not (isinstance(enumerator, Sequence) and enumerator.is_anonymous):
            yield enumerator

    for declaration in declarations:
        yield from visit(declaration)
