"""A struct array behaves as a list of its structs, and as numpy columns."""

from __future__ import annotations

import copy
import pickle
from collections.abc import MutableSequence
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.runtime import types as rt


class Mode(rt.Enum):
    Off = 0
    On = 2


class Point(rt.Struct):
    x: rt.Float = 0.0
    y: rt.Float = 0.0


class Contact(rt.Struct):
    id: rt.Byte = 0
    at: Point = rt.default()
    mode: Mode = Mode.Off
    firm: rt.Bool = False


class Points(rt.StructArray[Point]):
    __slots__ = ()


class Contacts(rt.StructArray[Contact]):
    __slots__ = ()


def contacts(count: int = 3) -> Contacts:
    return Contacts([Contact(i, Point(i, -i), Mode.On, i % 2 == 1) for i in range(count)])


def test_struct_array_row_is_live_view() -> None:
    rows = contacts()
    row = rows[1]
    assert isinstance(row, Contact)
    assert (row.id, row.at, row.mode, row.firm) == (1, Point(1.0, -1.0), Mode.On, True)
    assert (type(row.id), type(row.mode), type(row.firm)) == (int, Mode, bool)
    row.id, row.at.x, row.mode, row.firm = 9, 7.5, Mode.Off, False
    assert rows[1] == Contact(9, Point(7.5, -1.0), Mode.Off, False)
    rows[-1].at = Point(3.0, 4.0)
    assert rows.nested("at")[2] == Point(3.0, 4.0)


@pytest.mark.parametrize(
    ("name", "value"),
    [("id", 256), ("id", 1.5), ("mode", 1), ("firm", "no"), ("at", 5), ("at", Point(1e40, 0.0))],
)
def test_struct_array_row_rejects_invalid_value(name: str, value: Any) -> None:
    rows = contacts()
    with pytest.raises(rt.EncodeError):
        setattr(rows[1], name, value)
    assert rows == contacts()


def test_struct_array_copied_row_is_independent() -> None:
    rows = contacts()
    for duplicate in (
        copy.copy(rows[1]),
        copy.deepcopy(rows[1]),
        pickle.loads(pickle.dumps(rows[1])),
    ):
        assert type(duplicate) is Contact
        assert duplicate == rows[1]
        duplicate.id = 77
    assert rows == contacts()


def test_struct_array_columns_are_writable_views() -> None:
    rows = contacts()
    assert rows.column("mode").dtype == np.int32
    rows.column("id")[:] = 5
    rows.nested("at").column("y")[1:] = 2.5
    assert [(row.id, row.at.y) for row in rows] == [(5, 0.0), (5, 2.5), (5, 2.5)]


def test_struct_array_from_columns() -> None:
    at = Points.from_columns(x=[1, 2], y=np.array([3.0, 4.0]))
    rows = Contacts.from_columns(id=[1, 2], at=at, mode=Mode.On)
    assert rows == [
        Contact(1, Point(1.0, 3.0), Mode.On, False),
        Contact(2, Point(2.0, 4.0), Mode.On, False),
    ]
    assert len(Contacts.from_columns()) == 0


@pytest.mark.parametrize(
    ("columns", "error", "message"),
    [
        ({"z": [1]}, TypeError, "Point has no field z"),
        ({"x": [1], "y": [1, 2]}, ValueError, r"the columns differ in length: \[1, 2\]"),
        ({"x": [1, 1e40]}, rt.EncodeError, r"x\[1\]: 1e\+40 does not fit into float32"),
    ],
)
def test_struct_array_from_columns_rejects_invalid_columns(
    columns: Any, error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        Points.from_columns(**columns)


def test_struct_array_nested_suggests_column() -> None:
    with pytest.raises(TypeError, match="column"):
        contacts().nested("id")


def test_struct_array_is_constructed_from_numpy_array() -> None:
    mine = np.array([(1, 2), (3, 4)], [("y", "<f8"), ("x", "<i4")])
    assert Points(mine) == [Point(2.0, 1.0), Point(4.0, 3.0)]
    shared = np.asarray(Points([Point(1.0, 2.0)]))
    Points(shared)[0].x = 5.0
    assert shared["x"].tolist() == [5.0]


def test_struct_array_constructor_copies_other_array() -> None:
    rows = contacts()
    Contacts(rows)[0].id = 99
    assert rows == contacts()


class Pair:
    """A struct array and a list of the same structs; actions apply to both."""

    def __init__(self, values: list[float]) -> None:
        self.array = Points([Point(v, 0.0) for v in values])
        self.list = [Point(v, 0.0) for v in values]

    def do(self, action: Any) -> None:
        outcomes = []
        for sequence in (self.array, self.list):
            try:
                result = action(sequence)
                outcomes.append(copy.deepcopy(result))
            except (IndexError, ValueError) as error:
                outcomes.append(type(error))
        assert outcomes[0] == outcomes[1]
        assert self.array == self.list
        assert [p.x for p in self.array] == [p.x for p in self.list]


def copies(items: Any) -> list[Any]:
    """Objects that no other place of a list holds, as an array has them anyway."""
    return [copy.copy(item) for item in items]


numbers = st.integers(-9, 9).map(float)
indices = st.integers(-7, 7)
slices = st.slices(6)
points = st.lists(numbers.map(lambda x: Point(x, 1.0)), max_size=3)
actions = st.one_of(
    st.builds(lambda x: lambda a: a.append(Point(x, 2.0)), numbers),
    st.builds(lambda p: lambda a: a.extend(copies(p)), points),
    st.builds(lambda i, x: lambda a: a.insert(i, Point(x, 3.0)), indices, numbers),
    st.builds(lambda i: lambda a: a[i], indices),
    st.builds(lambda i: lambda a: a.pop(i), indices),
    st.builds(lambda i: lambda a: a.__delitem__(i), indices | slices),
    st.builds(lambda i, x: lambda a: a.__setitem__(i, Point(x, 4.0)), indices, numbers),
    st.builds(lambda s, p: lambda a: a.__setitem__(s, copies(p)), slices, points),
    st.builds(lambda i, x: lambda a: setattr(a[i], "y", x), indices, numbers),
    st.builds(lambda x: lambda a: (Point(x, 0.0) in a, a.count(Point(x, 0.0))), numbers),
    st.builds(lambda x: lambda a: a.remove(Point(x, 0.0)), numbers),
    st.just(lambda a: a.reverse()),
    st.just(lambda a: a.sort(key=lambda p: (p.x, p.y))),
    st.just(lambda a: a.sort(key=lambda p: p.y, reverse=True)),
    st.just(lambda a: a.extend(copies(a))),
    st.just(len),
    st.just(lambda a: list(reversed(a))),
)


@settings(max_examples=200)
@given(st.lists(numbers, max_size=5), st.lists(actions, max_size=8))
def test_struct_array_behaves_as_list(start: list[float], todo: list[Any]) -> None:
    pair = Pair(start)
    for action in todo:
        pair.do(action)
    pair.do(lambda a: a.clear())


def test_struct_array_slices_share_and_selections_copy() -> None:
    rows = Points.from_columns(x=np.arange(6), y=0)
    rows[::2].column("y")[:] = 1
    assert rows.column("y").tolist() == [1, 0, 1, 0, 1, 0]
    assert type(rows[1:3]) is Points
    assert [p.x for p in rows[rows.column("y") > 0]] == [0, 2, 4]
    assert rows[np.argsort(-rows.column("x"))][0].x == 5


def test_struct_array_append_to_slice_leaves_original() -> None:
    rows = contacts(4)
    rows.append(Contact(9))  # now there is room behind
    part = rows[:2]
    part.append(Contact(77))
    assert [row.id for row in rows] == [0, 1, 2, 3, 9]
    assert [row.id for row in part] == [0, 1, 77]


def test_struct_array_extends_by_itself() -> None:
    rows = contacts(2)
    rows.extend(rows)
    assert [row.id for row in rows] == [0, 1, 0, 1]


def test_struct_array_implements_sequence_protocol() -> None:
    rows = Points([Point(1.0, 2.0)] * 9)
    assert isinstance(rows, MutableSequence)
    assert repr(Points([Point(1.0, 2.0)])) == "Points([Point(x=1.0, y=2.0)])"
    assert repr(rows).endswith(", … 9 in all])")
    assert rows != [Point(1.0, 2.0)]
    assert rows != contacts(9)
    with pytest.raises(IndexError, match="index 9 of Points with 9 elements"):
        rows[9]
    with pytest.raises(TypeError):
        hash(rows)


def test_struct_array_is_copied_and_pickled() -> None:
    for rows in (contacts(), contacts()[::2], contacts().nested("at")):
        for again in (copy.copy(rows), copy.deepcopy(rows), pickle.loads(pickle.dumps(rows))):
            assert type(again) is type(rows)
            assert again == rows
            again.clear()
            assert len(rows)


def test_struct_array_rejects_struct_with_string_field() -> None:
    class Named(rt.Struct):
        name: rt.String = ""

    class NamedList(rt.StructArray[Named]):
        __slots__ = ()

    with pytest.raises(TypeError, match="name: no number, so no fixed size"):
        NamedList()
