"""The parameters of a component: loaded once, described, changed while it runs.

In: a configuration file and overrides. Out: the base of the generated parameters class.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from robocomp_dsl.finding import Location, SourceText
from robocomp_dsl.runtime.parameters import saved, value_list
from robocomp_dsl.runtime.parameters import scalar as scalars
from robocomp_dsl.runtime.parameters.errors import ParameterRejected
from robocomp_dsl.runtime.parameters.group import build_group, walk_parameters
from robocomp_dsl.runtime.parameters.live import apply_changes
from robocomp_dsl.runtime.parameters.load import load_values
from robocomp_dsl.runtime.parameters.schema import Kind, Parameter, ParameterGroup, Value
from robocomp_dsl.runtime.parameters.tree import Scalar, TextSyntax


@dataclass(frozen=True, slots=True)
class Description:
    """One parameter for introspection; `name` is its path, such as `motors[2].min`."""

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
    type: str
    """As PDSL writes it, with the length of a list: `float[1:8]`."""


class Parameters(ParameterGroup):
    """Base of the generated parameters of a component.

    Single attributes are read without a lock. `set` and `values` exclude each other, so `values`
    never sees half of a change.
    """

    __slots__ = ("_changed", "_lock", "_save_target", "_worker")
    _lock: threading.RLock
    _worker: object
    _save_target: tuple[Path, Path] | None
    _changed: set[str]

    @classmethod
    def load(
        cls,
        path: Path | str | None = None,
        overrides: Iterable[str] = (),
        *,
        save_beside: Path | None = None,
    ) -> Self:
        """Load the YAML or TOML file at `path`; `overrides` (`motors[2].min=-1`) take precedence.

        `save` writes live values to a file beside `save_beside`; values saved there before are
        loaded, too. Raises `ConfigError` with all problems.
        """
        save_target = (save_beside, saved.saved_path(save_beside)) if save_beside else None
        values = load_values(
            cls.SCHEMA,
            None if path is None else Path(path),
            overrides,
            save_target and save_target[1],
        )
        parameters = build_group(cls, values)
        for name, value in (
            ("_lock", threading.RLock()),
            ("_worker", None),
            ("_save_target", save_target),
        ):
            object.__setattr__(parameters, name, value)
        object.__setattr__(
            parameters,
            "_changed",
            set(saved.saved_parameters(save_target[1])) if save_target else set(),
        )
        return parameters

    def bind(self, worker: object) -> None:
        """Register the hooks of `worker` for live changes.

        Before a change `will_set_<name>(value)` is called for every parameter that changes, then
        `will_set(changes)` once; each may raise `ParameterRejected`. After it
        `did_set_<name>(old)` is called. In groups the names are joined with `_` and list positions
        follow the value: `will_set_motors_min(value, 2)`.
        """
        object.__setattr__(self, "_worker", worker)

    def set(self, changes: Mapping[str, Value]) -> None:
        """Change live parameters by path, all or none.

        Raises `ParameterRejected` with all reasons: unknown, not live, wrong type, out of range, or
        rejected by a hook. `weights[2]` is one element of a list.
        """
        with self._lock:
            self._changed.update(apply_changes(self, self._worker, changes, _from_python))

    def set_text(self, changes: Mapping[str, str]) -> None:
        """As `set`, with values as typed on a command line."""
        with self._lock:
            self._changed.update(apply_changes(self, self._worker, changes, _from_text))

    def save(self) -> Path:
        """Save the changed live values for the next start; returns the path of the file.

        Raises `ParameterRejected` if they cannot be saved.
        """
        with self._lock:
            if self._save_target is None:
                raise ParameterRejected(
                    "this component was started without a file to save values in"
                )
            config, file = self._save_target
            current = self.values()
            try:
                saved.write(file, config, {p: current[p] for p in self._changed if p in current})
            except OSError as error:
                raise ParameterRejected(
                    f"`{file}` cannot be written: {error.strerror or error}"
                ) from None
            return file

    def values(self) -> dict[str, Value]:
        """Every value by its path."""
        with self._lock:
            return {
                path: _value(owner, parameter) for path, owner, parameter in walk_parameters(self)
            }

    def describe(self) -> list[Description]:
        """Every parameter with its value, range and documentation, in the order of the PDSL."""
        with self._lock:
            return [
                _description(path, owner, parameter)
                for path, owner, parameter in walk_parameters(self)
            ]


def _description(path: str, owner: ParameterGroup, parameter: Parameter) -> Description:
    value = _value(owner, parameter)
    bounds = (parameter.low, parameter.high, parameter.unit, parameter.choices)
    kind, default = parameter.kind, parameter.default
    about = (parameter.live, parameter.doc, value_list.describe_type(parameter))
    return Description(path, kind, value, default, *bounds, *about)


def _value(owner: ParameterGroup, parameter: Parameter) -> Any:
    """The value; of a list a copy, which the caller may change."""
    value = getattr(owner, parameter.attribute)
    return list(value) if parameter.is_list else value


def _from_python(parameter: Parameter, path: str, value: object) -> Value:
    convert = value_list.from_python if parameter.is_list else scalars.from_python
    return convert(parameter, path, value)


def _from_text(parameter: Parameter, path: str, text: str) -> Value:
    place = Location(SourceText(path, (text,)), 1, 1)
    convert = value_list.from_text if parameter.is_list else scalars.from_scalar
    return convert(parameter, path, Scalar(place, text, TextSyntax.RAW))
