"""Reserved and colliding names in every place: the output is typed, formatted and importable."""

from __future__ import annotations

import keyword
import random
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from robocomp_dsl.generate import names
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.model import types as t
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.interface import Interface, Module, Operation, Param, Pattern
from robocomp_dsl.source import Source
from tests.generate import golden_cases as golden

HERE = Source(Path("x.idsl"), "").file_span
TABLES = (value for name, value in vars(names).items() if name.isupper())
OWN = """self cls query command publish request request_ _ __ _x __x __init__ __class__ __slots__
_fields_ _names_ _element_ _bind _link _call_a a b c x x_ x__ Pose PoseProxy POSE pose laser_proxy
laser Laser LASER LaserProxy other value error zero T Self Link np_ rt_ PoseParams"""
LONG = ["a" * 40, "B" * 42]
POOL = sorted(
    {*keyword.kwlist, *keyword.softkwlist, *OWN.split(), *LONG}.union(
        *(table for table in TABLES if isinstance(table, frozenset))
    )
)
PLAIN = (t.BOOL, t.BYTE, t.SHORT, t.INT, t.LONG, t.FLOAT, t.DOUBLE, t.STRING)


class RandomComponent:
    """A component of three modules, of random names."""

    def __init__(self, seed: int) -> None:
        self.rng = random.Random(seed)
        self.types: list[t.Type] = list(PLAIN)
        self.errors: list[t.ExceptionType] = []
        self.interfaces: list[Interface] = []

    def component(self) -> Component:
        modules: list[Module] = []
        for name in ("One", "Two", "Three"):
            declarations = tuple(self.declaration(name, n) for n in self.rng.sample(POOL, 40))
            path = Path(f"{name}.idsl")
            modules.append(Module(name, path, HERE, "", tuple(modules), declarations))
        ports = tuple(self.ports())
        name = self.rng.choice(POOL)
        return Component(name, Path("c.cdsl"), HERE, "Python", tuple(modules), ports)

    def ports(self) -> Iterator[Port]:
        sides = (Role.IMPLEMENTS, Role.SUBSCRIBES), (Role.REQUIRES, Role.PUBLISHES)
        for side in sides:
            chosen = dict.fromkeys(n.lower() for n in self.rng.sample(POOL, len(POOL)))
            for interface, name in zip(self.interfaces * 2, chosen, strict=False):
                yield Port(self.rng.choice(side), interface, name, HERE)

    def declaration(self, module: str, name: str) -> t.Declaration:
        make = self.rng.choice(
            [
                self.struct,
                self.struct,
                self.error,
                self.enum,
                self.sequence,
                self.dictionary,
                self.interface,
            ]
        )
        return make(module, name)

    def type(self) -> t.Type:
        return self.rng.choice(self.types[-20:] + self.types[:8])

    def fields(self) -> tuple[t.Field, ...]:
        chosen = self.rng.sample(POOL, self.rng.randrange(6))
        return tuple(t.Field(n, self.type(), HERE) for n in chosen)

    def register(self, type_: t.Type) -> t.Declaration:
        self.types.append(type_)
        assert isinstance(type_, t.Declaration)
        return type_

    def struct(self, module: str, name: str) -> t.Declaration:
        return self.register(t.Struct(module, name, HERE, "", self.fields()))

    def error(self, module: str, name: str) -> t.Declaration:
        self.errors.append(t.ExceptionType(module, name, HERE, "", self.fields()))
        return self.errors[-1]

    def enum(self, module: str, name: str) -> t.Declaration:
        chosen = self.rng.sample(POOL, self.rng.randrange(1, 5))
        values = tuple(t.Enumerator(n, i, HERE) for i, n in enumerate(chosen))
        return self.register(t.Enum(module, name, HERE, "", values))

    def sequence(self, module: str, name: str) -> t.Declaration:
        return self.register(t.Sequence(module, name, HERE, "", self.type()))

    def dictionary(self, module: str, name: str) -> t.Declaration:
        key = self.rng.choice([t.STRING, t.INT])
        return self.register(t.Dictionary(module, name, HERE, "", key, self.type()))

    def interface(self, module: str, name: str) -> t.Declaration:
        chosen = self.rng.sample(POOL, self.rng.randrange(8))
        operations = tuple(self.operation(n) for n in chosen)
        self.interfaces.append(Interface(module, name, HERE, "", operations))
        return self.interfaces[-1]

    def operation(self, name: str) -> Operation:
        chosen = iter(self.rng.sample(POOL, 6))
        inputs, outputs = (
            tuple(Param(next(chosen), self.type(), HERE) for _ in range(self.rng.randrange(3)))
            for _ in range(2)
        )
        result = self.type() if self.rng.random() < 0.5 else None
        one_way = (Pattern.UNMARKED, Pattern.COMMAND)
        pattern = Pattern.QUERY if result or outputs else self.rng.choice(one_way)
        throws = tuple(self.errors[:2])
        return Operation(name, HERE, pattern, inputs, outputs, result, throws, False, False)


COMMANDS = (
    [str(shutil.which("ruff")), "check", "--isolated", "--no-cache", "-q", "."],
    [str(shutil.which("ruff")), "format", "--isolated", "--no-cache", "-q", "--diff", "."],
    [sys.executable, "-m", "mypy", "--strict", "--config-file=", "--no-error-summary", "."],
    [sys.executable, "-c", "import specificworker"],
)


@pytest.mark.parametrize("seed", [1, 2])
def test_generated_code_with_random_names_is_clean_and_importable(
    seed: int, tmp_path: Path
) -> None:
    golden.put(plan(RandomComponent(seed).component()), tmp_path)
    for command in COMMANDS:
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
