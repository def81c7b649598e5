"""Parameters of PDSL, resolved."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TypeAlias

from robocomp_dsl.model.types import Literal
from robocomp_dsl.record import Record
from robocomp_dsl.source import Span


class Kind(StrEnum):
    """The type of a parameter. `CHOICE` is an enumeration, `GROUP` a list of groups."""

    STRING = "string"
    INT = "int"
    FLOAT = "float"
    BOOL = "bool"
    CHOICE = "choice"
    GROUP = "group"


PATH = "path"
"""The type of a STRING that names a file or folder."""


Default: TypeAlias = Literal | tuple[Literal, ...]
"""The default of a parameter; of a list the values with which it starts."""


class Parameter(Record):
    """One parameter. `default` None: a value is required.

    `low` and `high` bound a number (inclusive) or the length of a group list; either may be None.
    `choices` only for CHOICE, `members` only for GROUP. A group with `single` is one nested group
    and no list. `is_path`: a STRING that names an existing file or folder, declared as `path`.
    A list of values of `kind` has `shortest` to `longest` elements, None: any number; `shortest` of
    a single value and of a group is None.
    """

    name: str
    kind: Kind
    span: Span
    default: Default | None = None
    low: float | None = None
    high: float | None = None
    unit: str = ""
    live: bool = False
    choices: tuple[str, ...] = ()
    members: tuple[Parameter, ...] = ()
    single: bool = False
    doc: str = ""
    is_path: bool = False
    shortest: int | None = None
    longest: int | None = None

    @property
    def is_list(self) -> bool:
        """Whether it is a list of values."""
        return self.shortest is not None

    def describe_length(self) -> str:
        """`1 to 8 elements`, `3 elements` or `1 or more elements`."""
        low, high = self.shortest or 0, self.longest
        if high is None:
            return f"{low} or more elements" if low else "any number of elements"
        counted = f"{low}" if low == high else f"{low} to {high}"
        return f"{counted} element{'' if high == 1 else 's'}"

    @property
    def type_name(self) -> str:
        """The type as PDSL writes it; of a CHOICE and a GROUP the name of the kind."""
        return PATH if self.is_path else self.kind.value


class ParameterSet(Record):
    """One PDSL file."""

    name: str
    path: Path
    span: Span
    parameters: tuple[Parameter, ...]
    doc: str = ""
