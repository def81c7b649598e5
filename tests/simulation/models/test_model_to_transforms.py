"""The transform tree of a compiled model against MuJoCo's own kinematics, to 1e-9 m."""

import math

import mujoco
import numpy as np
import pytest

from robocomp_dsl.hardware.devices.errors import CommandRefused
from robocomp_dsl.hardware.kinematics.jacobian import jacobian
from robocomp_dsl.hardware.kinematics.rotations import angles, rotation
from robocomp_dsl.simulation.models.model_to_transforms import ModelTransforms, model_transforms
from robocomp_dsl.simulation.robots.build import add_robot, new_world
from robocomp_dsl.simulation.robots.catalog import ROBOTS
from robocomp_dsl.simulation.scene import axes

NEAR = 1e-9
JOINT = mujoco.mjtJoint


def random_position(model, random) -> np.ndarray:  # type: ignore[no-untyped-def]
    """Any position of all joints; quaternions of any length but 0."""
    result = random.uniform(-2, 2, model.nq)
    for j in range(model.njnt):
        kind = JOINT(model.jnt_type[j])
        if kind in (JOINT.mjJNT_FREE, JOINT.mjJNT_BALL):
            at = model.jnt_qposadr[j] + (3 if kind == JOINT.mjJNT_FREE else 0)
            result[at : at + 4] = random.normal(size=4)
    return result


def assert_trees_agree(model, found: ModelTransforms, random, moves: int = 3) -> None:  # type: ignore[no-untyped-def]
    data = mujoco.MjData(model)
    for move in range(moves):
        data.qpos[:] = random_position(model, random) if move else model.qpos0
        mujoco.mj_kinematics(model, data)  # normalises quaternions in place
        found.follow(data.qpos)
        for i, name in enumerate(found.bodies):
            expected = axes.matrix(data.xpos[i], data.xmat[i])
            result = found.tree.matrix(name, "root")
            assert np.abs(result[:3, :3] - expected[:3, :3]).max() < NEAR, name
            assert np.abs(result[:3, 3] - expected[:3, 3]).max() * axes.MM < NEAR, name


@pytest.mark.parametrize("free", [False, True])
@pytest.mark.parametrize("name", list(ROBOTS))
def test_transforms_of_shipped_robots_match_mujoco(name: str, free: bool) -> None:
    spec = new_world()
    add_robot(spec, ROBOTS[name](), free=free)
    model = spec.compile()
    found = model_transforms(model)
    assert_trees_agree(model, found, np.random.default_rng(3))
    assert set(ROBOTS[name]().joints) <= {joint.name for joint in found.joints}


def random_model(seed: int, count: int):  # type: ignore[no-untyped-def]
    """Bodies with up to three joints of any kind about any axis through any point."""
    random = np.random.default_rng(seed)

    def some(kind: str, count: int) -> str:
        result = random.normal(size=count) if kind == "turn" else random.uniform(-0.3, 0.3, count)
        return " ".join(map(repr, result.tolist()))

    heads, below = [], [[] for _ in range(count + 1)]
    for i in range(1, count + 1):
        free = i % 11 == 5
        below[0 if free else int(random.integers(max(0, i - 100), i))].append(i)
        name = f'name="b{i}"' if i % 4 else ""
        head = f'<body {name} pos="{some("place", 3)}" quat="{some("turn", 4)}">'
        head += '<inertial mass="1" pos="0 0 0" diaginertia="1 1 1"/>'
        # MuJoCo takes a minute to read 15 000 joints
        still = free or (count > 1000 and i % 16)
        joints = 0 if still else int(random.integers(0, 4))
        for j in range(joints):
            kind = "ball" if i % 7 == 3 and j == 2 else ("hinge", "slide", "hinge")[j]
            ref = "" if kind == "ball" else f'ref="{random.uniform(-1, 1)}"'
            head += f'<joint name="b{i}.{j}" type="{kind}" pos="{some("place", 3)}" {ref}'
            head += "/>" if kind == "ball" else f' axis="{some("turn", 3)}"/>'
        heads.append(head + ("<freejoint/>" if free else ""))
    text = '<mujoco><compiler angle="radian"/><worldbody>'
    todo: list[int] = below[0][::-1]
    while todo:
        i = todo.pop()
        text += heads[i - 1] if i else "</body>"
        if i:
            todo += [0, *below[i][::-1]]
    return mujoco.MjModel.from_xml_string(text + "</worldbody></mujoco>")


@pytest.mark.parametrize(("seed", "count"), [(0, 1), (1, 30), (2, 60), (3, 300), (4, 10_000)])
def test_transforms_of_random_trees_match_mujoco(seed: int, count: int) -> None:
    model = random_model(seed, count)
    assert model.nbody == count + 1
    assert_trees_agree(
        model, model_transforms(model), np.random.default_rng(seed), moves=3 if count < 1000 else 2
    )


def test_transforms_use_unique_names_of_model() -> None:
    model = mujoco.MjModel.from_xml_string(
        """<mujoco><worldbody><body name="root"><joint name="root" type="hinge"/><geom size=".1"/>
        <body><joint type="slide"/><geom size=".1"/><site name="tip" pos="0 0 1"/></body></body>
        </worldbody></mujoco>"""
    )
    found = model_transforms(model)
    assert found.bodies == ("root", "root#2", "body2")
    assert [joint.frame for joint in found.joints] == ["root#3", "body2.joint0"]
    assert found.tree.transform((0, 0, 0), "tip", "root") == pytest.approx((0, 1000, 0))


def test_transforms_jacobians_match_mujoco() -> None:
    spec = new_world()
    add_robot(spec, ROBOTS["nao_h25"]())
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[:] = np.random.default_rng(1).uniform(-1, 1, model.nq)
    mujoco.mj_forward(model, data)
    found = model_transforms(model)
    found.follow(data.qpos)
    names = [joint.frame for joint in found.joints]
    result = jacobian(found.tree, names, "l_hand")
    place, turn = np.zeros((3, model.nv)), np.zeros((3, model.nv))
    mujoco.mj_jacSite(model, data, place, turn, model.site("l_hand").id)
    assert result[:3] * axes.MM == pytest.approx(place[[0, 2, 1]], abs=NEAR)
    # an axis of turning changes its sense where a frame changes its hand
    assert result[3:] == pytest.approx(-turn[[0, 2, 1]], abs=NEAR)
    assert np.abs(place).max() > 0.1


def test_transforms_refuse_non_finite_values() -> None:
    found = model_transforms(random_model(1, 12))
    for joint in found.joints:
        qpos = np.zeros(200)
        qpos[joint.address] = math.nan
        with pytest.raises(CommandRefused, match="must be a finite number"):
            found.follow(qpos)


@pytest.mark.parametrize("off", [0.0, 1e-15, 1e-13, 1e-12, 1e-10, 1e-8, 1e-6, 1e-3])
@pytest.mark.parametrize("sign", [1, -1])
def test_transforms_angles_round_trip_near_pole(off: float, sign: int) -> None:
    turned = rotation(0.7, sign * (math.pi / 2 - off), -1.1)
    assert np.abs(rotation(*angles(turned)) - turned).max() < 1e-11
