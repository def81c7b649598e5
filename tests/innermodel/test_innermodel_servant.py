"""`InnerModel` of a component and `InnerModelManager` of a simulator agree about the same file."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from robocomp_dsl.innermodel import InnerModel
from tests.innermodel.random_trees import pose_matrix, random_tree
from tests.simulation.served_worlds import Served, served

IDS = [f"f{number}" for number in range(14)]
FRAMES = ("transform", "translation", "rotation", "joint", "prismaticjoint", "omnirobot")


def agree(model: InnerModel, world: Served, rng: random.Random) -> None:
    """Assert that both have the same poses, points and matrices."""
    manager = world.ports["InnerModelManager"]
    for _ in range(25):
        to, start = rng.choice(IDS), rng.choice(IDS)
        matrix = model.getTransformationMatrix(to, start)
        _, pose = manager.getPose(to, start)
        found = pose_matrix(pose.x, pose.y, pose.z, pose.rx, pose.ry, pose.rz)
        assert found == pytest.approx(matrix, abs=1e-5)
        data = manager.getTransformationMatrix(to, start).data
        assert data.reshape(4, 4) == pytest.approx(matrix, abs=1e-2)  # 32 bits on the wire
        point = [rng.uniform(-500, 500) for _ in range(3)]
        _, seen = manager.transform(to, start, world.types.coord3D(*point))
        expected = model.transform(to, point, start)
        assert [seen.x, seen.y, seen.z] == pytest.approx(list(expected), abs=1e-5)


@pytest.mark.parametrize("seed", range(3))
def test_innermodel_agrees_with_simulators_servant(seed: int, tmp_path: Path) -> None:
    rng = random.Random(seed)
    text = random_tree(seed, len(IDS), FRAMES, leaves=("imu", "plane"))
    model, world = InnerModel.fromString(text), served(tmp_path, text)
    manager = world.ports["InnerModelManager"]
    assert {node.id: node.parentId for node in manager.getAllNodeInformation()} == {
        name: model.getParentIdentifier(name) for name in model.getIDKeys()
    }
    agree(model, world, rng)
    nodes = [model.getNode(name) for name in IDS]
    transforms = [node.id for node in nodes if node and node.tag == "transform"]
    for name in transforms:
        pose = [rng.uniform(-400, 400) for _ in range(3)] + [rng.uniform(-3, 3) for _ in range(3)]
        outside = {"root", *IDS} - set(model.getSubTree(name))
        base = rng.choice(sorted(outside))
        manager.setPose(base, name, world.types.Pose3D(*pose))
        model.updateTransformValuesV(name, pose, base)
    assert transforms
    agree(model, world, rng)
