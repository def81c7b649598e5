"""Sequences of fixed structs: one numpy structured array with the interface of a list.

In: struct objects, columns, structured arrays or received bytes. Out: `StructArray`; one object per
element would be two orders of magnitude slower to send and receive.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, MutableSequence
from typing import Any, Generic, Never, Self, TypeVar, get_args, overload

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.runtime.data.convert import as_array, described
from robocomp_dsl.runtime.data.errors import EncodeError
from robocomp_dsl.runtime.data.layout import row_layout
from robocomp_dsl.runtime.data.per_class_cache import once
from robocomp_dsl.runtime.data.rows import row_view, row_views, rows_of, writable
from robocomp_dsl.runtime.data.schema import StructArrayBase, Type
from robocomp_dsl.runtime.data.struct import Struct
from robocomp_dsl.runtime.data.values import shown_items

T = TypeVar("T", bound=Struct)


class StructArray(MutableSequence[T], StructArrayBase):
    """A list of structs of numbers, stored as one numpy structured array.

    `scan[3].dist` reads and writes the array, `column("dist")` is a writable numpy view of all.
    Slices share the data, and an array of indices or bools selects, both as in numpy. `append` and
    `insert` may reallocate; earlier views then refer to the old memory.
    Received arrays are read-only views of the message: `copy()` them before changing elements.

    Constructed from struct objects, or from a structured numpy array with the same field names,
    which is shared if its dtype is identical. Raises `EncodeError` for values that do not fit.
    """

    __slots__ = ("_array", "_store")
    _array: NDArray[Any]  # what is in the list
    _store: NDArray[Any]  # with room to grow behind

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        if "_element_" not in cls.__dict__ and "__orig_bases__" in cls.__dict__:
            (cls._element_,) = get_args(cls.__dict__["__orig_bases__"][0])

    def __init__(self, items: Iterable[T] | NDArray[Any] = ()) -> None:
        rows = self._rows(items)
        self._array = self._store = rows.copy() if isinstance(items, StructArray) else rows

    @classmethod
    def from_columns(cls, **columns: Any) -> Self:
        """An array from one sequence per field, all of one length; a single number is repeated.

        Nested structs are passed as struct arrays; omitted fields are zero.
        """
        if unknown := set(columns) - set(cls._element_._names_):
            raise TypeError(f"{cls._element_.__name__} has no field {', '.join(sorted(unknown))}")
        lengths = {len(column) for column in columns.values() if np.ndim(column)}
        if len(lengths) > 1:
            raise ValueError(f"the columns differ in length: {sorted(lengths)}")
        self = cls(np.zeros(lengths.pop() if lengths else 0, row_layout(cls._element_).dtype))
        for name, values in columns.items():
            self._fill(name, values)
        return self

    def _fill(self, name: str, values: Any) -> None:
        type_ = self._field_type(name)
        target = self._array[name]
        if isinstance(type_, type) and issubclass(type_, Struct):
            target[...] = array_class(type_)._rows(values)
            return
        if not np.ndim(values):
            values = np.full(len(target), values)
        try:
            target[...] = as_array(values, target.dtype)
        except EncodeError as error:
            raise EncodeError(error.reason, name + error.path) from None

    @classmethod
    def _field_type(cls, name: str) -> Type:
        element = cls._element_
        found: Type = dict(zip(element._names_, (t for _, t in element._fields_), strict=True))[
            name
        ]
        return found

    @classmethod
    def _rows(cls, items: Any) -> NDArray[Any]:
        """`items` as an array with the layout of this type."""
        if isinstance(items, StructArray):
            if items._element_._plain_ is cls._element_:
                return items._array
        elif isinstance(items, np.ndarray) and items.dtype.names is not None:
            return cls._from_structured(items)
        if isinstance(items, str | bytes | dict) or not isinstance(items, Iterable):
            name = cls._element_.__name__
            raise EncodeError(f"takes a sequence of {name}, not {described(items)}")
        return rows_of(cls._element_, items)

    @classmethod
    def _from_structured(cls, items: NDArray[Any]) -> NDArray[Any]:
        dtype = row_layout(cls._element_).dtype
        if items.ndim != 1:
            raise EncodeError(f"takes a one-dimensional array, not one of shape {items.shape}")
        if items.dtype == dtype:
            return items
        names = items.dtype.names or ()
        if set(names) != set(cls._element_._names_):
            raise EncodeError(f"takes the fields {cls._element_._names_}, not {names}")
        return cls.from_columns(**{name: items[name] for name in names})._array

    @classmethod
    def _over(cls, array: NDArray[Any]) -> Self:
        """A list over `array`, whose dtype must match."""
        self = cls.__new__(cls)
        self._array = self._store = array
        return self

    def column(self, name: str) -> NDArray[Any]:
        """The numbers of one field of all elements, shape (n,): a view, not a copy.

        Enum columns hold ints. For a struct field use `nested`.
        """
        return self._array[name]

    def nested(self, name: str) -> StructArray[Any]:
        """One struct field of all elements: a struct array that shares the data."""
        type_ = self._field_type(name)
        if not (isinstance(type_, type) and issubclass(type_, Struct)):
            raise TypeError(f"{name} is no struct; column({name!r}) gives its numbers")
        return array_class(type_)._over(self._array[name])

    def copy(self) -> Self:
        """The same elements in their own, writable memory."""
        return self._over(self._array.copy())

    def __iter__(self) -> Iterator[T]:
        return row_views(self._element_, self._array)

    def __len__(self) -> int:
        return len(self._array)

    @overload
    def __getitem__(self, index: int) -> T: ...
    @overload
    def __getitem__(self, index: slice | NDArray[Any]) -> Self: ...
    def __getitem__(self, index: int | slice | NDArray[Any]) -> T | Self:
        if isinstance(index, slice | np.ndarray):
            return self._over(self._array[index])
        row: T = row_view(self._element_, self._array, self._checked(index))
        return row

    def _checked(self, index: int) -> int:
        """`index` as a non-negative index. Raises `IndexError`."""
        count = len(self._array)
        if not -count <= index < count:
            raise IndexError(f"index {index} of {type(self).__name__} with {count} elements")
        return index % count

    @overload
    def __setitem__(self, index: int, value: T) -> None: ...
    @overload
    def __setitem__(self, index: slice, value: Iterable[T]) -> None: ...
    def __setitem__(self, index: int | slice, value: Any) -> None:
        if not isinstance(index, slice):
            index = self._checked(index)
            writable(self._array)[index : index + 1] = rows_of(self._element_, (value,))
            return
        rows = self._rows(value)
        span = range(len(self._array))[index]
        if len(rows) == len(span):
            writable(self._array)[index] = rows.copy()  # it may be a view of this array
        elif span.step == 1:
            before, behind = self._array[: span.start], self._array[max(span.start, span.stop) :]
            self._array = self._store = np.concatenate([before, rows, behind])
        else:
            raise ValueError(f"{len(rows)} elements for {len(span)} places")

    def __delitem__(self, index: int | slice) -> None:
        where = index if isinstance(index, slice) else self._checked(index)
        self._array = self._store = np.delete(self._array, where)

    def insert(self, index: int, value: T) -> None:
        """See `list.insert`; copies all elements, unlike `append`."""
        self[index:index] = rows_of(self._element_, (value,))

    def append(self, value: T) -> None:
        """See `list`."""
        self._extend(rows_of(self._element_, (value,)))

    def extend(self, values: Iterable[T]) -> None:
        """See `list`."""
        self._extend(self._rows(values))

    def clear(self) -> None:
        """See `list`."""
        self._array = self._store = np.zeros(0, self._array.dtype)

    def reverse(self) -> None:
        """See `list`."""
        self._array = self._store = self._array[::-1]

    def sort(self, *, key: Callable[[T], Any], reverse: bool = False) -> None:
        """See `list.sort`; structs have no order, so `key` is required.

        For a single field `scan[numpy.argsort(scan.dist)]` is much faster.
        """
        keys = [key(row) for row in self]
        order = sorted(range(len(keys)), key=keys.__getitem__, reverse=reverse)
        self._array = self._store = self._array[order]

    def _extend(self, rows: NDArray[Any]) -> None:
        count, total = len(self._array), len(self._array) + len(rows)
        # Only memory allocated by this list has spare capacity that no other view sees.
        if total > len(self._store) or self._store is self._array:
            store = np.zeros(max(total, 2 * count, 8), row_layout(self._element_).dtype)
            store[:count] = self._array
            self._store = store
        self._store[count:total] = rows
        self._array = self._store[:total]

    def __eq__(self, other: object) -> bool:
        if isinstance(other, StructArray):
            if other._element_._plain_ is not self._element_._plain_:
                return NotImplemented
            return len(self) == len(other) and bool((self._array == other._array).all())
        return list(self) == other if isinstance(other, list) else NotImplemented

    __hash__ = None  # type: ignore[assignment]  # it changes, as a list does

    def __repr__(self) -> str:
        return f"{type(self).__name__}({shown_items(self)})"

    def __array__(
        self, dtype: np.dtype[Any] | None = None, copy: bool | None = None
    ) -> NDArray[Any]:
        """The structured array itself, for `numpy.asarray`."""
        if dtype is not None and dtype != self._array.dtype:
            return self._array.astype(dtype)
        return self._array.copy() if copy else self._array

    def __reduce__(self) -> tuple[Any, ...]:
        """Copied and pickled with its own data; the class is found through the element's class."""
        cls = type(self)
        if cls.__dict__.get("_anonymous_"):
            return _restored, (cls._element_, self._array.copy())
        return cls, (self._array.copy(),)


def _restored(element: type[Struct], array: NDArray[Any]) -> StructArray[Any]:
    return array_class(element)(array)


@once
def array_class(element: type[Struct]) -> type[StructArray[Any]]:
    """The struct array class of an element without a sequence in any IDSL file."""
    members = {"__slots__": (), "_element_": element, "_anonymous_": True}
    return type(f"{element.__name__}Array", (StructArray,), members)


D = TypeVar("D", bound=np.generic)
E = TypeVar("E", bound=Struct)


class Column(Generic[D]):
    """A descriptor: the numbers of one field of all elements of a `StructArray`, as a view.

    `field` is the attribute of the elements if it differs from the array's attribute.
    """

    def __init__(self, field: str = "") -> None:
        self._field = field

    def __set_name__(self, owner: type, name: str) -> None:
        self._field = self._field or name

    def __get__(self, array: StructArray[Any], owner: type) -> NDArray[D]:
        return array._array[self._field]

    def __set__(self, array: StructArray[Any], value: Never) -> None:
        raise AttributeError(f"write into the column: `.{self._field}[:] = ...`")


class NestedColumn(Generic[E]):
    """A descriptor for a struct field: a struct array that shares the data."""

    def __init__(self, element: type[E], field: str = "") -> None:
        self._element = element
        self._field = field

    def __set_name__(self, owner: type, name: str) -> None:
        self._field = self._field or name

    def __get__(self, array: StructArray[Any], owner: type) -> StructArray[E]:
        return array_class(self._element)._over(array._array[self._field])

    def __set__(self, array: StructArray[Any], value: Never) -> None:
        raise AttributeError(f"write into the columns of `.{self._field}`")
