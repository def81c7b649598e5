"""How long the calls of `InnerModel` take: transforms of a resting and of a moving robot, loading.

Prints the rows of the table in docs/reference/innermodel_api.md.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from robocomp_dsl.innermodel import InnerModel

ROUNDS = 5
POINT = (10.0, 20.0, 30.0)


def text(branches: int, depth: int) -> str:
    """A robot with `branches` chains of `depth` joints."""
    chains = []
    for branch in range(branches):
        heads = [f'<joint id="j{branch}_{n}" tx="100" axis="z" rx="0.1">' for n in range(depth)]
        chains.append("".join(heads) + "</joint>" * depth)
    return f'<innerModel><transform id="world">{"".join(chains)}</transform></innerModel>'


def microseconds(call: Callable[[], object], repeat: int) -> float:
    """The shortest mean time of a call over several rounds."""
    best = float("inf")
    for _ in range(ROUNDS):
        start = time.perf_counter()
        for _ in range(repeat):
            call()
        best = min(best, time.perf_counter() - start)
    return best / repeat * 1e6


def durations(source: str, joint: str, tip: str) -> dict[str, float]:
    """The duration of each call in µs."""
    model = InnerModel.fromString(source)
    scan = np.ones((1000, 3))

    def move() -> None:
        model.updateJointValue(joint, 0.5)
        model.transform("world", POINT, tip)

    return {
        "`transform`": microseconds(lambda: model.transform("world", POINT, tip), 20000),
        "`transform` of 1000 points": microseconds(
            lambda: model.transform("world", scan, tip), 2000
        ),
        "`transform6D`": microseconds(lambda: model.transform6D("world", tip), 5000),
        "`updateJointValue`, then `transform`": microseconds(move, 2000),
        "load": microseconds(lambda: InnerModel.fromString(source), 1),
        "`toString`": microseconds(model.toString, 2),
    }


def main() -> None:
    """Measure a robot with 30 joints, and a world with 1000."""
    robot, world = (
        durations(text(branches, 10), "j0_5", f"j{branches - 1}_9") for branches in (3, 100)
    )
    for call, duration in robot.items():
        print(f"| {call} | {duration:.3g} | {world[call]:.3g} |")


if __name__ == "__main__":
    main()
