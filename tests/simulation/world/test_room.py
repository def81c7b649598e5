from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.hardware.kinematics.planar import Pose
from robocomp_dsl.runtime.parameters import ConfigError
from robocomp_dsl.simulation.scene.floor_plan import clearance, outlines
from robocomp_dsl.simulation.scene.room import Pillar, Room, RoomBox, Wall
from robocomp_dsl.simulation.world.world import World

TEXT = """\
walls:
  - {x1: 0, z1: 0, x2: 4000, z2: 0}
boxes:
  - {name: table, x: 1000, z: 2000, width: 800, depth: 400, alpha: 1.5707963267948966}
pillars:
  - {x: 3000, z: 1000, radius: 250}
start: {x: 500, z: 600, alpha: 0.25}
"""


def test_room_file_is_read(tmp_path: Path) -> None:
    path = tmp_path / "room.yaml"
    path.write_text(TEXT)
    assert Room.read(path) == Room(
        walls=(Wall(0, 0, 4000, 0, 100, 1000),),
        boxes=(RoomBox("table", 1000, 2000, 800, 400, 700, 1.5707963267948966),),
        pillars=(Pillar("", 3000, 1000, 250, 1000),),
        start=Pose(500, 600, 0.25),
    )


def test_room_errors_name_their_lines(tmp_path: Path) -> None:
    path = tmp_path / "room.yaml"
    path.write_text(TEXT.replace("x2: 4000", "x2: far").replace("radius: 250", "radios: 250"))
    with pytest.raises(ConfigError) as error:
        Room.read(path)
    message = str(error.value)
    assert f"{path}:2:" in message
    assert f"{path}:6:" in message
    assert "did you mean `radius`?" in message


def test_room_outlines_are_seen_from_above(tmp_path: Path) -> None:
    path = tmp_path / "room.yaml"
    path.write_text(TEXT)
    wall, table, pillar = outlines(World(Room.read(path).spec()).model)
    assert [wall.name, table.name, pillar.name] == ["wall 1", "box 1 table", "pillar 1"]
    assert wall.corners.min(axis=0) == pytest.approx([-50, -50])
    assert wall.corners.max(axis=0) == pytest.approx([4050, 50])
    # a quarter turn exchanges width and depth
    assert table.corners.min(axis=0) == pytest.approx([800, 1600])
    assert table.corners.max(axis=0) == pytest.approx([1200, 2400])
    assert np.linalg.norm(pillar.corners - [3000, 1000], axis=1) == pytest.approx(
        np.full(48, 250.0)
    )


def test_room_box_with_positive_angle_turns_right() -> None:
    room = Room(boxes=(RoomBox("", 0, 0, 200, 2000, 100, 0.3),))
    (box,) = outlines(World(room.spec()).model)
    end = box.corners[box.corners[:, 1] > 800].mean(axis=0)
    assert end == pytest.approx([1000 * np.sin(0.3), 1000 * np.cos(0.3)], abs=1e-3)


def test_room_clearance_is_distance_to_nearest_outline() -> None:
    room = Room(
        walls=(Wall(0, 0, 4000, 0, 100, 1000),), pillars=(Pillar("", 3000, 1000, 250, 1000),)
    )
    things = outlines(World(room.spec()).model)
    points = np.array([[1000.0, 450.0], [3000.0, 1500.0]])
    distances, feet = clearance(points, things)
    assert distances == pytest.approx([400, 250], abs=1)
    assert feet[0] == pytest.approx([1000, 50])
    assert clearance(points, ())[0].tolist() == [np.inf, np.inf]
