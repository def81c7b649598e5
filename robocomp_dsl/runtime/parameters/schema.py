"""Schema of the parameters of a component: constants in generated code.

In: the arguments that the generator writes from a PDSL file. Out: `Parameter` and `Group`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

if TYPE_CHECKING:
    from robocomp_dsl.runtime.parameters.group import ParameterGroup

Kind: TypeAlias = Literal["string", "int", "float", "bool", "choice"]
Value: TypeAlias = bool | int | float | str

KIND_NAMES: dict[str, str] = {
    "string": "a string",
    "int": "a whole number",
    "float": "a number",
    "bool": "true or false",
    "choice": "a name",
}
"""Names of the kinds in messages."""


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter. `default` None: required. `low` and `high` are inclusive, in `unit`.

    `attribute` is its Python name if that differs from `name` (a keyword, or a name that
    `Parameters` uses itself). `live`: it may change while the component runs.
    """

    name: str
    kind: Kind
    default: Value | None = None
    low: float | None = None
    high: float | None = None
    unit: str = ""
    choices: tuple[str, ...] = ()
    live: bool = False
    doc: str = ""
    attribute: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "attribute", self.attribute or self.name)


@dataclass(frozen=True, slots=True)
class Group:
    """Parameters that belong together: a list of `low` to `high` groups, or one with `single`."""

    name: str
    type: type[ParameterGroup]
    low: int | None = None
    high: int | None = None
    single: bool = False
    doc: str = ""
    attribute: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "attribute", self.attribute or self.name)


Entry: TypeAlias = Parameter | Group
Schema: TypeAlias = tuple[Entry, ...]
