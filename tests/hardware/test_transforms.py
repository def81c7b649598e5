import math

import numpy as np
import pytest

from robocomp_dsl.hardware.description.scene import Frame, Motion
from robocomp_dsl.hardware.devices.errors import CommandRefused, FrameError
from robocomp_dsl.hardware.kinematics.jacobian import jacobian
from robocomp_dsl.hardware.kinematics.rotations import angles, inverse, rotation
from robocomp_dsl.hardware.kinematics.transforms import TransformTree

QUARTER = math.pi / 2


def arm() -> TransformTree:
    """A base turned to the right by a quarter, a shoulder, a slide and a hand."""
    return TransformTree(
        [
            Frame("base", "root", (1000, 0, 2000), (0, QUARTER, 0)),
            Frame("shoulder", "base", (0, 500, 0), motion=Motion("hinge", "x")),
            Frame("reach", "shoulder", (0, 0, 30), motion=Motion("slide", "z", offset=10)),
            Frame("hand", "reach", (0, 0, 200)),
        ]
    )


@pytest.mark.parametrize(
    ("point", "source", "target", "found"),
    [
        ((1, 2, 3), "hand", "hand", (1, 2, 3)),
        ((0, 0, 0), "base", "root", (1000, 0, 2000)),
        # a quarter to the right: ahead (z) of the base is x of the room, its right (x) is -z
        ((0, 0, 100), "base", "root", (1100, 0, 2000)),
        ((100, 0, 0), "base", "root", (1000, 0, 1900)),
        ((0, 0, 0), "hand", "root", (1230, 500, 2000)),
        ((1230, 500, 2000), "root", "hand", (0, 0, 0)),
        ((0, 0, 0), "root", "base", (2000, 0, -1000)),
    ],
)
def test_transform_tree_converts_points_between_frames(
    point: tuple[float, ...], source: str, target: str, found: tuple[float, ...]
) -> None:
    tree = arm()
    assert tree.transform(point, source, target) == pytest.approx(found, abs=1e-9)
    many = tree.transform_all(np.array([point, point], dtype=float), source, target)
    assert many[1] == pytest.approx(found, abs=1e-9)


def test_transform_tree_joints_move_their_children() -> None:
    tree = arm()
    assert tree.joint("reach") == 20
    tree.set_joint("reach", 120)
    assert tree.transform((0, 0, 0), "hand", "root") == pytest.approx((1330, 500, 2000))
    tree.set_joint("shoulder", -QUARTER)  # z of the shoulder turns to y: up
    assert tree.transform((0, 0, 0), "hand", "root") == pytest.approx((1000, 830, 2000))
    assert tree.joint("shoulder") == -QUARTER
    assert tree.transform((0, 0, 0), "shoulder", "root") == pytest.approx((1000, 500, 2000))


def test_transform_tree_rotates_in_order_x_y_z() -> None:
    whole = rotation(0.3, -0.7, 1.1)
    assert whole == pytest.approx(rotation(0.3, 0, 0) @ rotation(0, -0.7, 0) @ rotation(0, 0, 1.1))
    assert rotation(0, 0, QUARTER) @ [1, 0, 0] == pytest.approx([0, 1, 0])
    assert rotation(QUARTER, 0, 0) @ [0, 1, 0] == pytest.approx([0, 0, 1])
    assert rotation(0, QUARTER, 0) @ [0, 0, 1] == pytest.approx([1, 0, 0])


@pytest.mark.parametrize("ry", [0.4, -1.2, QUARTER, -QUARTER])
def test_transform_tree_angles_round_trip(ry: float) -> None:
    turned = rotation(0.5, ry, -2.0)
    assert rotation(*angles(turned)) == pytest.approx(turned, abs=1e-9)
    if abs(ry) < QUARTER:
        assert angles(turned) == pytest.approx((0.5, ry, -2.0))


def test_transform_tree_pose_has_any_reference_frame() -> None:
    tree = arm()
    assert tree.pose("base", "root") == pytest.approx((1000, 0, 2000, 0, QUARTER, 0))
    tree.set_pose("base", (0, 0, 0, 0, 0, 0))
    assert tree.pose("hand", "root") == pytest.approx((0, 500, 230, 0, 0, 0))
    matrix = tree.matrix("root", "hand")
    assert matrix @ inverse(matrix) == pytest.approx(np.eye(4))


def test_transform_tree_adds_removes_and_moves_frames() -> None:
    tree = arm()
    tree.add(Frame("cup", "hand", (0, 0, 10)))
    assert tree.transform((0, 0, 0), "cup", "root") == pytest.approx((1240, 500, 2000))
    tree.move("cup", "base")
    assert tree.transform((0, 0, 0), "cup", "root") == pytest.approx((1010, 0, 2000))
    assert tree.parent("cup") == "base"
    assert len(tree) == 6
    tree.remove("shoulder")
    assert len(tree) == 3
    assert "hand" not in tree
    with pytest.raises(FrameError, match="there is no frame `hand`"):
        tree.transform((0, 0, 0), "hand", "root")
    tree.add(Frame("hand", "cup"))
    assert tree.path("hand") == ("hand", "cup", "base", "root")


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda t: t.add(Frame("hand", "base")), "there is a frame `hand` already"),
        (lambda t: t.add(Frame("x", "nowhere")), "there is no frame `nowhere`"),
        (lambda t: t.move("base", "hand"), "`hand` is part of `base` and cannot hold it"),
        (lambda t: t.move("base", "base"), "`base` is part of `base` and cannot hold it"),
        (lambda t: t.remove("root"), "`root` is the root and stays where it is"),
        (lambda t: t.set_joint("base", 1.0), "`base` is no joint"),
        (lambda t: t.set_joint("shoulder", math.nan), "`value` is nan, it must be a finite number"),
        (lambda t: t.set_pose("base", (0, 0)), "a pose has six numbers, not 2"),
        (lambda t: t.set_pose("base", (0, 0, 0, 0, math.inf, 0)), "`ry` is inf"),
        (lambda t: t.transform((0, 0, 0), "root", "gone"), "there is no frame `gone`"),
        (lambda t: jacobian(t, ["base"], "hand"), "`base` is no joint"),
    ],
)
def test_transform_tree_refuses_invalid_changes_unchanged(wrong: object, message: str) -> None:
    tree = arm()
    with pytest.raises((FrameError, CommandRefused)) as refusal:
        wrong(tree)  # type: ignore[operator]
    assert message in str(refusal.value)
    assert tree.transform((0, 0, 0), "hand", "root") == pytest.approx((1230, 500, 2000))


@pytest.mark.parametrize("base", ["root", "base"])
def test_transform_tree_jacobian_is_derivative(base: str) -> None:
    random = np.random.default_rng(4)
    names = [f"j{i}" for i in range(9)]
    tree = TransformTree([Frame("base", "root", (10, 20, 30), (0.3, 0.4, 0.5))])
    for i, name in enumerate(names):
        place, turn = random.uniform(-200, 200, 3), random.uniform(-2, 2, 3)
        motion = Motion("slide" if i % 3 == 2 else "hinge", "xyz"[i % 3 - i // 3])  # type: ignore[arg-type]
        parent = names[i - 1] if i else "base"
        tree.add(Frame(name, parent, tuple(place.tolist()), tuple(turn.tolist()), motion))
    tree.add(Frame("aside", "j3", motion=Motion("hinge", "y")))
    point = (5.0, -7.0, 11.0)
    found = jacobian(tree, [*names, "aside"], "j8", base=base, point=point)
    assert found.shape == (6, 10)
    assert not found[:, 9].any()
    step = 1e-6
    for column, name in enumerate(names):
        here = tree.joint(name)
        tree.set_joint(name, here + step)
        after, turned = np.array(tree.transform(point, "j8", base)), tree.matrix("j8", base)
        tree.set_joint(name, here - step)
        before, was = np.array(tree.transform(point, "j8", base)), tree.matrix("j8", base)
        tree.set_joint(name, here)
        assert found[:3, column] == pytest.approx((after - before) / (2 * step), abs=1e-3)
        spin = (turned[:3, :3] - was[:3, :3]) / (2 * step) @ tree.matrix("j8", base)[:3, :3].T
        assert found[3:, column] == pytest.approx([spin[2, 1], spin[0, 2], spin[1, 0]], abs=1e-6)


def test_transform_tree_may_be_deep() -> None:
    frames = [Frame(f"f{i}", f"f{i - 1}" if i else "root", (0, 0, 1)) for i in range(5000)]
    tree = TransformTree(frames)
    assert tree.transform((0, 0, 0), "f4999", "root") == pytest.approx((0, 0, 5000))
    tree.remove("f10")
    assert len(tree) == 11
