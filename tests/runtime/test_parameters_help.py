"""`--help` of a component lists its parameters."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.entry_point import main
from robocomp_dsl.runtime.parameters import Parameters
from robocomp_dsl.runtime.parameters.schema import Group, Parameter, ParameterGroup


class Limit(ParameterGroup):
    """In a motor."""

    SCHEMA = (Parameter("at", "float", 0.0, unit="rad"),)


class Motor(ParameterGroup):
    """One of some."""

    SCHEMA = (
        Parameter("gain", "float", 1.5, low=0, unit="V", live=True, doc="Gain of\nthe motor."),
        Group("limits", Limit, 0, 3, doc="Where it stops."),
    )


class ArmParams(Parameters):
    """All of them."""

    SCHEMA = (
        Parameter("device", "string", doc="Serial device: 100 % of it."),
        Parameter("mode", "choice", "fast", choices=("fast", "slow"), high=None),
        Parameter("count", "int", 1, low=1, high=9),
        Group("motors", Motor, 1, None),
        Group("only", Limit, single=True, doc="One group."),
    )


class Arm(Component):
    """Has parameters."""

    SPEC = ComponentSpec(name="arm", period=0, middleware="inproc", parameters=ArmParams)


HELP = """\
parameters (in the configuration file, or with --set):
  device=<string>  required
      Serial device: 100 % of it.
  mode=fast|slow  'fast' if not given
  count=<int>  1 to 9, 1 if not given
  motors[N]  1 or more groups, N from 0
  motors[N].gain=<float>  at least 0 V, 1.5 if not given, may change while running
      Gain of the motor.
  motors[N].limits[N]  0 to 3 groups, N from 0
      Where it stops.
  motors[N].limits[N].at=<float>  in rad, 0.0 if not given
  only
      One group.
  only.at=<float>  in rad, 0.0 if not given
"""


def test_program_help_lists_parameters(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as leaving:
        main(Arm, ["--help"])
    assert leaving.value.code == 0
    assert capsys.readouterr().out.endswith(HELP)
