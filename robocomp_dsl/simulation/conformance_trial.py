"""Runs conformance rules against a simulated device.

In: a rule, a scene file that `rcgen` generated, and the ids of the device. Out: nothing, or
`Violation`.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.hardware.conformance.rule import ConformanceRule
from robocomp_dsl.hardware.conformance.trial import subject_of
from robocomp_dsl.simulation.world.simulation import Simulation


def on_simulation(rule: ConformanceRule, scene: Path, ids: Sequence[str]) -> None:
    """Run `rule` on the device, or on the joints, `ids` of the world in `scene`.

    Time advances as fast as the machine allows. Raises `Violation`.
    """
    simulation = Simulation.read(scene)
    rule.check(subject_of(simulation.devices[ids[0]], ids), simulation.advance)
