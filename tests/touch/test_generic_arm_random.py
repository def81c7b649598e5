"""Whatever `generic_arm` is told, the arm stays within its limits and the component answers."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.waiting import wait_until
from tests.touch.arm_client import ARM, FIRST_BOARD, RunningArm, arm_on

SLACK = 0.04  # rad: what a joint that is stopped at its limit runs over
CATCHING_UP = 1.8  # of the speed limit: a joint that lags behind its reference, or was pushed


def command(arm: RunningArm, chance: np.random.Generator) -> str:
    """Anything, sensible or not; the operation that was called."""
    limits = arm.getLimits()
    wide = np.where(chance.random() < 0.3, 10.0, 1.0)
    angles = limits.low + (limits.high - limits.low) * (chance.random(5) * wide - (wide - 1) / 2)
    rates = wide * limits.speed * chance.uniform(-1, 1, 5)
    x, y, z = chance.uniform(-0.4, 0.4, 3).tolist()
    name = str(chance.choice(["move", "moveBy", "reach", "follow", "drive", "glide", "stop"]))
    commands = {
        "move": (angles, np.abs(rates) + 0.05 if chance.random() < 0.5 else np.zeros(0)),
        "moveBy": (rates * 0.3, np.zeros(0)),
        "reach": (x, y, z),
        "follow": (arm.getState().position + 0.05 * chance.uniform(-1, 1, 5),),
        "drive": (rates,),
        "glide": (x, y, z),
        "stop": (),
    }[name]
    try:
        getattr(arm, name)(*commands)
    except (ARM.interfaces.Unreachable, ARM.interfaces.NotPossible):
        return f"{name}, refusal_of"
    return name


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("robot", ["nao_h25", "icub_v2"])
def test_generic_arm_stays_in_limits_with_random_commands(robot: str, seed: int) -> None:
    chance = np.random.default_rng(seed)
    with arm_on(robot) as (arm, served):
        limits, board, asked = arm.getLimits(), served.part.board, []
        served.after[FIRST_BOARD[robot], "getState"] = lambda _: asked.append(
            np.abs(board.references.velocity) / board.limits.speed
        )
        done = set()
        for _ in range(60):
            done.add(command(arm, chance))
            time = arm.getState().time
            wait_until(lambda time=time: arm.states[-1].time > time + 0.1)
        assert {"move", "drive", "glide", "reach, refusal_of"} <= done
        positions = np.array([state.position for state in arm.states])
        speeds = np.abs([state.velocity for state in arm.states])
        assert (positions > limits.low - SLACK).all(), (limits.low - positions.min(axis=0)).max()
        assert (positions < limits.high + SLACK).all(), (positions.max(axis=0) - limits.high).max()
        assert np.max(asked) <= 1.001  # no reference is faster than its joint may be
        assert (speeds <= CATCHING_UP * limits.speed).all(), (speeds / limits.speed).max(axis=0)
        assert arm.runner.statistics.failures == 0
        arm.stop()
        arm.wait_for_rest()
