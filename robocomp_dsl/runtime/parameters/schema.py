"""Schema of the parameters of a component: constants in generated code.

In: the arguments that the generator writes from a PDSL file. Out: `Parameter` and `Group`, and the
base class of generated groups, whose attributes are plain reads (no descriptor, no lock).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal, TypeAlias

Kind: TypeAlias = Literal["string", "int", "float", "bool", "choice"]
Element: TypeAlias = bool | int | float | str
"""A value, or one of a list."""
Value: TypeAlias = Element | Sequence[Element]
"""The value of a parameter; that of a list is a list."""

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
    `Parameters` uses itself). `live`: it may change while the component runs. A list of values of
    `kind` has `shortest` to `longest` elements, None: any number; `shortest` of a single value is
    None. Choices and bounds apply to each element.
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
    shortest: int | None = None
    longest: int | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "attribute", self.attribute or self.name)

    @property
    def is_list(self) -> bool:
        """Whether its value is a list."""
        return self.shortest is not None


class ParameterGroup:
    """Base of the generated class of one group; its attributes are the parameters of `SCHEMA`."""

    __slots__ = ()
    SCHEMA: ClassVar[Schema] = ()

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(
            f"`{name}` cannot be assigned: parameters change through `set`, "
            f'as in self.params.set({{"{name}": {value!r:.40}}})'
        )

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"`{name}` cannot be deleted, it is a parameter")

    def __repr__(self) -> str:
        shown = ", ".join(f"{e.attribute}={getattr(self, e.attribute)!r}" for e in self.SCHEMA)
        return f"{type(self).__name__}({shown})"


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
