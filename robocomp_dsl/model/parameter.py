"""Parameters of PDSL, resolved."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path

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


class Parameter(Record):
    """One parameter. `default` None: a value is required.

    `low` and `high` bound a number (inclusive) or the length of a group list; either may be None.
    `choices` only for CHOICE, `members` only for GROUP. A group with `single` is one nested group
    and no list. `is_path`: a STRING that names an existing file or folder, declared as `path`.
    """

    name: str
    kind: Kind
    span: Span
    default: Literal | None = None
    low: float | None = None
    high: float | None = None
    unit: str = ""
    live: bool = False
    choices: tuple[str, ...] = ()
    members: tuple[Parameter, ...] = ()
    single: bool = False
    doc: str = ""
    is_path: bool = False

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
