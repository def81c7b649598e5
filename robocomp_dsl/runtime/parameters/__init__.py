"""Parameters of a component: loaded from YAML or TOML, checked, typed, changed while it runs."""

from typing import TYPE_CHECKING, Any

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.runtime.parameters.errors import ConfigError, ParameterRejected
from robocomp_dsl.runtime.parameters.load import load_values
from robocomp_dsl.runtime.parameters.schema import Group, Parameter, ParameterGroup, Schema, Value
from robocomp_dsl.runtime.parameters.values import Description, Parameters

if TYPE_CHECKING:
    Refused = ParameterRejected

__all__ = [
    "ConfigError",
    "Description",
    "Finding",
    "Group",
    "Location",
    "Parameter",
    "ParameterGroup",
    "ParameterRejected",
    "Parameters",
    "Schema",
    "SourceText",
    "Value",
    "load_values",
]


def __getattr__(name: str) -> Any:
    """The deprecated name `Refused` of `ParameterRejected`."""
    if name == "Refused":
        from robocomp_dsl.runtime.deprecated import warn_deprecated  # noqa: PLC0415 - seldom needed

        warn_deprecated("Refused", "ParameterRejected")
        return ParameterRejected
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
