"""Descriptions that change at random: operations, types, ports and parameters come and go."""

from __future__ import annotations

import random
from dataclasses import dataclass, field

TYPES = ("int", "float", "bool", "string", "Word", "Tone", "Words", "Mood", "Table")
DECLARED = """\
    struct Word { string text; int weight = 3; };
    struct Tone { float pitch; };
    sequence<Word> Words;
    enum Mood { calm, loud };
    dictionary<string, Tone> Table;
"""
VALUES = {"int": "3", "float": "2.5", "bool": "true", "string": '"a"', "{on, off}": "off"}
ROLES = ("implements", "requires", "publishes", "subscribesTo")


@dataclass
class RandomDescriptions:
    """The current descriptions. An operation is (mark, result, inputs, outputs)."""

    rng: random.Random
    operations: dict[str, dict[str, tuple[str, str, tuple[str, ...], tuple[str, ...]]]] = field(
        default_factory=lambda: {"Talk": {}, "Ear": {}}
    )
    ports: list[tuple[str, str]] = field(default_factory=lambda: [("implements", "Talk")])
    parameters: dict[str, str] = field(default_factory=dict)
    states: list[str] = field(default_factory=list)
    period: int = 10

    def edit(self) -> None:
        """One change."""
        change = self.rng.choice(
            [
                self.add,
                self.add,
                self.remove,
                self.rename,
                self.retype,
                self.connect,
                self.parameter,
                self.state,
            ]
        )
        change()

    def add(self) -> None:
        interface = self.rng.choice(list(self.operations))
        name = f"do{self.rng.randrange(12)}"
        self.operations[interface][name] = self._operation(topic=interface == "Ear")

    def remove(self) -> None:
        if found := self._random_operation():
            del self.operations[found[0]][found[1]]

    def rename(self) -> None:
        if found := self._random_operation():
            table = self.operations[found[0]]
            table[f"do{self.rng.randrange(12)}"] = table.pop(found[1])

    def retype(self) -> None:
        if found := self._random_operation():
            operation = self._operation(topic=found[0] == "Ear")
            self.operations[found[0]][found[1]] = operation

    def connect(self) -> None:
        if len(self.ports) > 1 and self.rng.random() < 0.5:
            self.ports.pop(self.rng.randrange(len(self.ports)))
            return
        role = self.rng.choice(ROLES)
        self.ports.append((role, "Talk" if role in ROLES[:2] else "Ear"))

    def parameter(self) -> None:
        name = f"p{self.rng.randrange(8)}"
        if self.parameters.pop(name, None) is None:
            self.parameters[name] = self.rng.choice(list(VALUES))

    def state(self) -> None:
        name = f"s{self.rng.randrange(6)}"
        if name in self.states:
            self.states.remove(name)
        else:
            self.states.append(name)

    def _random_operation(self) -> tuple[str, str] | None:
        found = [(i, o) for i, table in self.operations.items() for o in table]
        return self.rng.choice(found) if found else None

    def _operation(self, *, topic: bool) -> tuple[str, str, tuple[str, ...], tuple[str, ...]]:
        inputs = [self.rng.choice(TYPES) for _ in range(self.rng.randrange(4))]
        if topic:
            return "", "void", tuple(inputs), ()
        results = [self.rng.choice(TYPES) for _ in range(self.rng.randrange(3))]
        mark = "" if results else self.rng.choice(["", "[command] ", "[query] "])
        result = self.rng.choice(["void", *TYPES]) if results else "void"
        return mark, result, tuple(inputs), tuple(results)

    def idsl(self) -> str:
        parts = [DECLARED]
        for interface, table in self.operations.items():
            rows = "".join(
                f"        {self._written(name, operation)};\n" for name, operation in table.items()
            )
            parts.append(f"    interface {interface}\n    {{\n{rows}    }};\n")
        return f"module M\n{{\n{''.join(parts)}}};\n"

    @staticmethod
    def _written(name: str, operation: tuple[str, str, tuple[str, ...], tuple[str, ...]]) -> str:
        mark, result, inputs, outputs = operation
        parameters = [f"{type_} a{i}" for i, type_ in enumerate(inputs)]
        parameters += [f"out {type_} b{i}" for i, type_ in enumerate(outputs)]
        return f"{mark}{result} {name}({', '.join(parameters)})"

    def pdsl(self) -> str:
        rows = "".join(f"    {n} {t} {VALUES[t]};\n" for n, t in self.parameters.items())
        return f"ComponentParams talker\n{{\n{rows}}};\n"

    def smdsl(self) -> str:
        """A chain of the states; no state is final, so the component continues."""
        first, *rest = self.states or ["s"]
        states = f"    states {', '.join(rest)};\n" if rest else ""
        pairs = zip([first, *rest], [*rest, first], strict=True)
        transitions = "".join(f"        {a} => {b} on next;\n" for a, b in pairs)
        transitions = f"    transitions\n    {{\n{transitions}    }};\n" if rest else ""
        return f"machine\n{{\n    initial_state {first};\n{states}{transitions}}};\n"

    def cdsl(self) -> str:
        machine = 'statemachine "talker.smdsl";\n    ' if self.states else ""
        ports = "".join(f"        {role} {name};\n" for role, name in self.ports)
        return (
            'import "Talk.idsl";\nComponent talker\n{\n    Communications\n    {\n'
            f"{ports}    }};\n    language Python;\n    middleware inproc;\n"
            f'    parameters "talker.pdsl";\n    {machine}period {self.period};\n}};\n'
        )
