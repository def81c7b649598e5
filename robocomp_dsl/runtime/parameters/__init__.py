"""Parameters of a component: loaded from YAML or TOML, checked, typed, changed while it runs."""

from robocomp_dsl.runtime.parameters.findings import ConfigError, Finding, Place, Refused
from robocomp_dsl.runtime.parameters.group import ParameterGroup
from robocomp_dsl.runtime.parameters.load import load_values
from robocomp_dsl.runtime.parameters.schema import Group, Parameter, Schema, Value
from robocomp_dsl.runtime.parameters.values import Description, Parameters

__all__ = [
    "ConfigError",
    "Description",
    "Finding",
    "Group",
    "Parameter",
    "ParameterGroup",
    "Parameters",
    "Place",
    "Refused",
    "Schema",
    "Value",
    "load_values",
]
