"""`str(struct)` is as from ZeroC Ice."""

from __future__ import annotations

from enum import Enum
from pathlib import Path
from types import ModuleType

import pytest

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.robocomp.texts import ice_text, use_texts_of_ice


class Kind(Enum):
    """An enumeration."""

    NEAR = 0
    FAR = 1


class Place(rt.Struct):
    """A struct of plain values."""

    x: rt.Float = 0.0
    moves: rt.Bool = False
    name: rt.String = ""


class Tour(rt.Struct):
    """A struct of structs, sequences and dictionaries."""

    start: Place = rt.default()
    angles: rt.Float32Array = rt.default()
    rooms: dict[rt.String, rt.Int] = rt.default()


PLACE = "\n{\n    x = 1.5\n    moves = True\n    name = hall\n}"
TOUR = """
{
    start = 
    {
        x = 1.5
        moves = True
        name = hall
    }
    angles = 
    {
        [0] = 0.5
        [1] = 1.0
    }
    rooms = 
    {
        key = attic
        value = 3
    }
}"""  # noqa: W291 - as Ice writes it


def test_ice_text_of_struct() -> None:
    place = Place(1.5, moves=True, name="hall")
    assert ice_text(place) == PLACE
    assert ice_text(Tour(place, [0.5, 1.0], {"attic": 3})) == TOUR
    assert ice_text([Kind.FAR]) == "\n{\n    [0] = FAR\n}"
    assert ice_text(b"a") == "\n{\n    [0] = 97\n}"
    assert ice_text([]) == "\n{\n}"


def test_use_texts_of_ice_changes_structs_of_module() -> None:
    class Spot(rt.Struct):
        x: rt.Int = 0

    module = ModuleType("interfaces")
    module.Spot, module.rt, module.Kind = Spot, rt, Kind  # type: ignore[attr-defined]
    use_texts_of_ice(module)
    assert f"{Spot(2)}" == repr(Spot(2)) == "\n{\n    x = 2\n}"
    assert str(Place()) != ice_text(Place())


def test_ice_text_agrees_with_ice(tmp_path: Path) -> None:
    ice = pytest.importorskip("Ice")
    source = tmp_path / "Texts.ice"
    source.write_text(
        "module Texts { sequence<float> Angles; dictionary<string, int> Rooms;\n"
        "struct Place { float x; bool moves; string name; };\n"
        "struct Tour { Place start; Angles angles; Rooms rooms; }; };"
    )
    ice.loadSlice(str(source))
    import Texts  # noqa: PLC0415

    place = Texts.Place(1.5, True, "hall")
    assert str(place) == PLACE
    assert str(Texts.Tour(place, [0.5, 1.0], {"attic": 3})) == TOUR
