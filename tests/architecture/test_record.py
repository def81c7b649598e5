"""Records: construction, comparison, immutability; interactive commands load no dataclasses."""

from __future__ import annotations

import subprocess
import sys
from functools import cached_property
from pathlib import Path

import pytest

from robocomp_dsl.record import Record, ValueRecord


class Place(ValueRecord):
    """A value with a default."""

    x: int
    y: int = 7


class Named(Place):
    """A value with a base."""

    name: str = "n"


class Alone(ValueRecord):
    """A single field is compared like several."""

    text: str


class Thing(Record):
    """Compared by identity; with a cached property."""

    parts: tuple[int, ...]
    __slots__ = ("__dict__",)

    @cached_property
    def total(self) -> int:
        """Computed at the first access."""
        return sum(self.parts)


class Flag(Record):
    """Without a field."""


def test_record_constructor_takes_base_fields_first() -> None:
    assert (Place(1).x, Place(1).y) == (1, 7)
    record = Named(1, 2, "here")
    assert (record.x, record.y, record.name) == (1, 2, "here")
    assert repr(Named(3, name="it")) == "Named(x=3, y=7, name='it')"
    assert repr(Flag()) == "Flag()"
    match record:
        case Named(x, y, name):
            assert (x, y, name) == (1, 2, "here")


def test_record_base_and_derived_constructors_are_independent() -> None:
    class Base(ValueRecord):
        a: int

    class Derived(Base):
        b: int

    assert Derived(1, 2).b == 2
    assert Base(1).a == 1
    assert Derived(3, 4).a == 3


@pytest.mark.parametrize(
    ("values", "named"), [((), {}), ((1, 2, 3), {}), ((1,), {"x": 2}), ((1,), {"z": 2})]
)
def test_record_rejects_unknown_arguments(values: tuple[int, ...], named: dict[str, int]) -> None:
    for _ in range(2):  # the first time the constructor is compiled
        with pytest.raises(TypeError):
            Place(*values, **named)


def test_value_records_compare_by_fields_and_records_by_identity() -> None:
    assert Place(1) == Place(1, 7)
    assert hash(Place(1)) == hash(Place(1, 7))
    assert Place(1) != Place(2)
    assert Place(1) != Named(1)
    assert len({Alone("a"), Alone("a"), Alone("b")}) == 2
    item = Thing((1, 2))
    assert item == item
    assert item != Thing((1, 2))


def test_record_is_immutable() -> None:
    record = Place(1)
    with pytest.raises(AttributeError, match="Place is frozen"):
        record.x = 2  # type: ignore[misc]
    with pytest.raises(AttributeError, match="Place is frozen"):
        del record.x
    assert not hasattr(record, "__dict__")
    assert Thing((1, 2)).total == 3


def test_record_replace_returns_copy() -> None:
    record = Named(1, 2, "a")
    assert record.replace(y=5) == Named(1, 5, "a")
    assert record == Named(1, 2, "a")
    with pytest.raises(TypeError):
        record.replace(z=1)


@pytest.mark.parametrize("command", ["check", "component"])
def test_interactive_commands_load_no_dataclasses(command: str, tmp_path: Path) -> None:
    """A dataclass in a module that they load is 0.7 ms of every start."""
    path = tmp_path / "it.cdsl"
    path.write_text(
        'import "Laser.idsl";\n'
        "Component it { Communications { requires Laser; }; language Python; };\n"
    )
    code = (
        "import sys\nfrom robocomp_dsl.cli.rcgen.main import main\n"
        "try: main()\nexcept SystemExit as end: assert not end.code\n"
        "ours = {n: m for n, m in sys.modules.items() if n.startswith('robocomp_dsl.')}\n"
        "slow = [name for name, module in ours.items() if hasattr(module, 'dataclass')]\n"
        "assert not slow, slow\n"
    )
    run = [sys.executable, "-c", code, command, str(path)]
    done = subprocess.run(run, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
