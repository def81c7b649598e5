"""Parameters of an arm, for the tests of configuration files."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.runtime.parameters import (
    ConfigError,
    Group,
    Parameter,
    ParameterGroup,
    Parameters,
)


class Limits(ParameterGroup):
    SCHEMA = (
        Parameter("low", "float", default=-1.0, unit="rad"),
        Parameter("high", "float", default=1.0, unit="rad"),
    )
    low: float
    high: float


class MotorsGroup(ParameterGroup):
    SCHEMA = (
        Parameter("name", "string"),
        Parameter("id", "int", default=0, low=0, high=127),
        Group("limits", Limits, single=True),
    )
    name: str
    id: int
    limits: Limits


class ArmParams(Parameters):
    SCHEMA = (
        Parameter("device", "string", default="/dev/ttyUSB0"),
        Parameter("rate", "float", default=50.0, low=1, high=1000, unit="Hz", live=True),
        Parameter("retries", "int", default=3, low=0),
        Parameter("mode", "choice", default="position", choices=("position", "velocity", "off")),
        Parameter("verbose", "bool", default=False),
        Parameter("lambda", "float", default=0.5, attribute="lambda_"),
        Group("motors", MotorsGroup, low=0, high=3),
    )
    device: str
    rate: float
    retries: int
    mode: str
    verbose: bool
    lambda_: float
    motors: list[MotorsGroup]


class RequiredParams(Parameters):
    SCHEMA = (Parameter("serial", "string"), Group("motors", MotorsGroup, low=1, high=2))
    serial: str
    motors: list[MotorsGroup]


def load(tmp_path: Path, text: str, *overrides: str, suffix: str = ".yaml") -> ArmParams:
    file = tmp_path / f"config{suffix}"
    file.write_text(text, encoding="utf-8")
    return ArmParams.load(file, overrides)


def error_lines(error: ConfigError) -> list[str]:
    return [f"{f.location.line}:{f.location.column} {f.message}" for f in error.findings]
