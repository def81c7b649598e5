"""A component that records the calls of its hooks, for the tests of the runtime."""

from __future__ import annotations

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.parameters import Parameter, ParameterRejected, Parameters


class ArmParams(Parameters):
    SCHEMA = (
        Parameter(
            "rate", "float", default=50.0, low=1, high=100, unit="Hz", live=True, doc="How often."
        ),
        Parameter("device", "string", default="/dev/null"),
        Parameter("weights", "float", default=(1.0,), high=9, live=True, shortest=1, longest=3),
    )
    rate: float
    device: str
    weights: list[float]


class Arm(Component):
    """Records the calls of its hooks."""

    SPEC = ComponentSpec(name="arm", period=1, parameters=ArmParams, middleware="inproc")
    params: ArmParams

    def __init__(self) -> None:
        self.calls: list[str] = []
        self.failing = False
        self.refusing = False

    def initialize(self) -> None:
        self.calls.append("initialize")

    def compute(self) -> None:
        if self.failing:
            raise RuntimeError("the arm does not move")
        self.calls.append("compute")

    def emergency(self) -> None:
        self.calls.append("emergency")

    def restore(self) -> None:
        self.calls.append("restore")

    def finalize(self) -> None:
        self.calls.append("finalize")

    def will_set_rate(self, value: float) -> None:
        if self.refusing:
            raise ParameterRejected("not while moving")

    def did_set_rate(self, old: float) -> None:
        self.calls.append(f"rate was {old:g}")


def arm_of(runner: Runner) -> Arm:
    assert isinstance(runner.worker, Arm)
    return runner.worker
