"""Python source of one function under construction, and the objects that it uses.

In: lines and constants. Out: the compiled function.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.data.schema import Array, Sequence

MAX_NESTED = 15  # Python rejects more than 20 nested blocks


class SourceWriter:
    """`names` are the objects that the lines use; `depth` is the indentation of the next line."""

    def __init__(self, names: dict[str, Any]) -> None:
        self.names = names
        self.lines: list[str] = []
        self.depth = 2
        self._count = 0
        self._loops = 0

    def line(self, text: str) -> None:
        """Add a line."""
        self.lines.append("    " * self.depth + text)

    def name(self, letter: str) -> str:
        """A new variable."""
        self._count += 1
        return f"{letter}{self._count}"

    def assigned(self, letter: str, expression: str) -> str:
        """A variable with this value."""
        if expression.isidentifier():
            return expression
        name = self.name(letter)
        self.line(f"{name} = {expression}")
        return name

    def constant(self, value: Any) -> str:
        """A name for an object that has no literal."""
        for name, known in self.names.items():
            if known is value:
                return name
        name = self.name("K")
        self.names[name] = value
        return name

    def nested(self, head: str, body: Callable[[], None]) -> None:
        """A loop with the lines that `body` adds."""
        self._loops += 1
        if self._loops > MAX_NESTED:
            raise TypeError(f"more than {MAX_NESTED} sequences within each other")
        self.line(head)
        self.depth += 1
        before = len(self.lines)
        body()
        if len(self.lines) == before:
            self.line("pass")
        self.depth -= 1
        self._loops -= 1

    def limit(self, type_: Array | Sequence, count: str) -> None:
        """Fail for a number of elements that the type does not have."""
        if type_.size:
            self.line(f"if {count} != {type_.size}: raise ValueError")
        elif type_.bound:
            self.line(f"if {count} > {type_.bound}: raise ValueError")

    def compiled(self, head: str, tail: str, name: str) -> Callable[..., Any]:
        """The function `name`, its body within `try`; `tail` follows after a failure."""
        source = "\n".join([head, "    try:", *self.lines, tail])
        exec(compile(source, f"<{name}>", "exec"), self.names)  # noqa: S102 - from the schema only
        function: Callable[..., Any] = self.names[name]
        return function
