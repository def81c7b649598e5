"""The parameters of a component: loaded once, described, changed while it runs.

In: a configuration file and overrides. Out: the base of the generated parameters class.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from robocomp_dsl.runtime.parameters import saved
from robocomp_dsl.runtime.parameters import scalar as scalars
from robocomp_dsl.runtime.parameters.findings import Place, Refused, Text
from robocomp_dsl.runtime.parameters.group import ParameterGroup, filled, walk
from robocomp_dsl.runtime.parameters.live import change
from robocomp_dsl.runtime.parameters.load import load_values
from robocomp_dsl.runtime.parameters.schema import Kind, Parameter, Value
from robocomp_dsl.runtime.parameters.tree import Scalar, Style


@dataclass(frozen=True, slots=True)
class Description:
    """One parameter as introspection shows it; `name` is its path, as in `motors[2].min`."""

    name: str
    kind: Kind
    value: Value
    default: Value | None
    low: float | None
    high: float | None
    unit: str
    choices: tuple[str, ...]
    live: bool
    doc: str


class Parameters(ParameterGroup):
    """Base of the generated parameters of a component.

    Single attributes are read without a lock. `set` and `values` exclude each other, so `values`
    never sees half of a change.
    """

    __slots__ = ("_changed", "_kept", "_lock", "_worker")
    _lock: threading.RLock
    _worker: object
    _kept: tuple[Path, Path] | None
    _changed: set[str]

    @classmethod
    def load(
        cls,
        path: Path | str | None = None,
        overrides: Iterable[str] = (),
        *,
        keeps: Path | None = None,
    ) -> Self:
        """What the YAML or TOML file at `path` says, `overrides` (`motors[2].min=-1`) above it.

        `keeps` is the configuration beside which `save` keeps live values; what it kept is read,
        too. Raises `ConfigError` with every problem of all.
        """
        kept = (keeps, saved.beside(keeps)) if keeps else None
        values = load_values(
            cls.SCHEMA, None if path is None else Path(path), overrides, kept and kept[1]
        )
        made = filled(cls, values)
        for name, value in (("_lock", threading.RLock()), ("_worker", None), ("_kept", kept)):
            object.__setattr__(made, name, value)
        object.__setattr__(made, "_changed", set(saved.paths(kept[1])) if kept else set())
        return made

    def bind(self, worker: object) -> None:
        """Let `worker` have its say in live changes.

        Before a change `will_set_<name>(value)` of every parameter that changes, then
        `will_set(changes)` once; each may raise `Refused`. After it `did_set_<name>(old)`. Inside
        groups the names are joined with `_` and list positions follow the value:
        `will_set_motors_min(value, 2)`.
        """
        object.__setattr__(self, "_worker", worker)

    def set(self, changes: Mapping[str, Value]) -> None:
        """Change live parameters by path, all or none.

        Raises `Refused` with every reason: unknown, not live, wrong type, out of range, or what a
        hook says.
        """
        with self._lock:
            self._changed.update(change(self, self._worker, changes, scalars.of_python))

    def set_text(self, changes: Mapping[str, str]) -> None:
        """As `set`, with values as one types them on a command line."""
        with self._lock:
            self._changed.update(change(self, self._worker, changes, _of_text))

    def save(self) -> Path:
        """Keep the live values that were changed for the next start; says where.

        Raises `Refused` where there is no place for them.
        """
        with self._lock:
            if self._kept is None:
                raise Refused("this component was started without a place to keep values in")
            config, file = self._kept
            current = self.values()
            try:
                saved.write(file, config, {p: current[p] for p in self._changed if p in current})
            except OSError as error:
                raise Refused(f"`{file}` cannot be written: {error.strerror or error}") from None
            return file

    def values(self) -> dict[str, Value]:
        """Every value by its path."""
        with self._lock:
            return {path: getattr(owner, one.attribute) for path, owner, one in walk(self)}

    def describe(self) -> list[Description]:
        """Every parameter with its value, range and documentation, in the order of the PDSL."""
        with self._lock:
            return [_description(path, owner, one) for path, owner, one in walk(self)]


def _description(path: str, owner: ParameterGroup, one: Parameter) -> Description:
    value: Any = getattr(owner, one.attribute)
    bounds = (one.low, one.high, one.unit, one.choices)
    return Description(path, one.kind, value, one.default, *bounds, one.live, one.doc)


def _of_text(parameter: Parameter, path: str, text: str) -> Value:
    place = Place(Text(path, (text,)), 1, 1)
    return scalars.of_scalar(parameter, path, Scalar(place, text, Style.RAW))
