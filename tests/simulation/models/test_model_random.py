"""Random trees in MJCF: whatever hangs together is served, held, and where the physics has it."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.simulation.scene import axes
from tests.simulation.served_worlds import served_model

SEEDS = range(12)


class Tree:
    """The text of a model: `driven` joints by boards, `loose` ones, all bodies."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.count = 0
        self.bodies: list[str] = []
        self.boards: dict[str, list[str]] = {"left": [], "right": [], "": []}
        self.loose: list[str] = []
        self.motors: list[str] = []
        self.slides: set[str] = set()

    def text(self) -> str:
        trees = "".join(self.body(f"{3 * i} 0 1", 3, free=i > 0) for i in range(2))
        tuples = "".join(
            f'<tuple name="{board}">'
            + "".join(f'<element objtype="joint" objname="{name}"/>' for name in names)
            + "</tuple>"
            for board, names in self.boards.items()
            if board and names
        )
        return (
            f'<mujoco><option timestep="0.001"/><worldbody>{trees}</worldbody>'
            f"<actuator>{''.join(self.motors)}</actuator><custom>{tuples}</custom></mujoco>"
        )

    def body(self, place: str, deep: int, *, free: bool) -> str:
        self.count += 1
        name = f"b{self.count}"
        self.bodies.append(name)
        inner = '<freejoint name="free"/>' if free else "".join(self.joints())
        radius = self.random.uniform(0.02, 0.05)
        inner += f'<geom size="{radius}" mass="0.3" contype="0" conaffinity="0"/>'
        inner += f'<site name="s{self.count}" pos="0 0.1 0" euler="10 20 30"/>'
        for _ in range(self.random.randint(1, 2) if deep else 0):
            x, y, z = (self.random.uniform(-0.2, 0.2) for _ in range(3))
            inner += self.body(f"{x} {y} {z}", deep - 1, free=False)
        turn = " ".join(str(self.random.randint(-90, 90)) for _ in range(3))
        return f'<body name="{name}" pos="{place}" euler="{turn}">{inner}</body>'

    def joints(self) -> list[str]:
        return [self.joint(f"j{self.count}_{i}") for i in range(self.random.randint(0, 2))]

    def joint(self, name: str) -> str:
        axis = " ".join(f"{self.random.uniform(-1, 1):.3f}" for _ in range(3))
        kind = self.random.choice(["hinge", "hinge", "slide"])
        if kind == "slide":
            self.slides.add(name)
        board = self.random.choice(["left", "right", "", "", "loose"])
        if board == "loose":
            self.loose.append(name)
        else:
            self.boards[board].append(name)
            self.motors.append(self.motor(name))
        return f'<joint name="{name}" type="{kind}" axis="{axis}" armature="0.6" damping="1"/>'

    def motor(self, joint: str) -> str:
        return self.random.choice(
            [
                f'<motor joint="{joint}" gear="100" ctrlrange="-1 1"/>',
                f'<position joint="{joint}" kp="70" forcerange="-100 100"/>',
                f'<general joint="{joint}" gainprm="10" biastype="affine" biasprm="1 2 3"/>',
            ]
        )


@pytest.mark.parametrize("seed", SEEDS)
def test_model_of_random_tree_matches_mujoco(seed: int, tmp_path: Path) -> None:
    tree = Tree(seed)
    world = served_model(tmp_path, tree.text())
    driven = [name for names in tree.boards.values() for name in names]
    for board, names in tree.boards.items():
        assert (board or "ControlBoard" in world.ports) or not names
        if names:
            port = world.ports[board or "ControlBoard"]
            assert {getJoint.name for getJoint in port.getJoints()} == set(names)
    if driven:
        before = np.array([world.simulation.state.joint(name) for name in driven])
        world.simulation.advance(0.5)
        after = np.array([world.simulation.state.joint(name) for name in driven])
        most = [20.0 if name in tree.slides else 0.05 for name in driven]  # mm or rad
        assert (np.abs(after - before) < most).all()
    data, nodes = world.simulation.world.data, world.ports["InnerModelManager"]
    for i, name in enumerate(tree.bodies, 1):
        for frame, place, turn in (
            (name, data.body(name).xpos, data.body(name).xmat),
            (f"s{i}", data.site(f"s{i}").xpos, data.site(f"s{i}").xmat),
        ):
            matrix = world.simulation.state.matrix(frame)
            assert np.abs(matrix - axes.matrix(place, turn)).max() < 1e-6, frame
    received = {node.id: node.parentId for node in nodes.getAllNodeInformation()}
    assert {*tree.bodies, *driven, *tree.loose} <= set(received)
    assert all(parent in received for parent in received.values() if parent)
