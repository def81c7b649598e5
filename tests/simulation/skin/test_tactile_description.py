"""`rcgen simulator --tactile`: skin of a description on the bodies of a world of any format."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.generate.scene.skin import lower_robot
from robocomp_dsl.hardware.description.scene_skin import Skin, geometry_of
from robocomp_dsl.tactile.description.read import read_robot
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from tests.simulation.served_worlds import rcgen

MJCF = """\
<mujoco>
  <worldbody>
    <body name="upper"> <joint name="bend" axis="0 1 0" range="-1 1"/>
      <geom type="capsule" size=".03" fromto="0 0 0 .2 0 0"/>
    </body>
  </worldbody>
  <compiler angle="radian"/>
  <actuator><motor joint="bend" ctrlrange="-5 5"/></actuator>
</mujoco>
"""
INNERMODEL = """\
<innerModel>
  <joint id="bend" axis="y" min="-1" max="1">
    <transform id="upper"> <plane id="shell" size="200,60,60" collide="1"/> </transform>
  </joint>
</innerModel>
"""
ARM = """\
robot: upper
parts:
  arm:
    servos:
      - {joint: bend, gamma: 1, sigma: 0, limits: [-1, 1], speed: 2}
    limbs:
      limb: {body: upper, cone: {x: [0, 200 mm], r: [30 mm, 30 mm]}}
    skin:
      - {patch: shell, limb: limb, first_id: 7, rings: {x: [50 mm, 100 mm], count: 6},
         sensitivity: {gain: 0.05, floor: 2, saturation: 240}}
"""


@pytest.mark.parametrize("world", [MJCF, INNERMODEL], ids=["MJCF", "InnerModel"])
def test_tactile_description_serves_skin_with_all_taxels(tmp_path: Path, world: str) -> None:
    (tmp_path / "world.xml").write_text(world)
    (tmp_path / "arm.yaml").write_text(ARM)
    values = ("simulator", "world.xml", "--tactile", "arm.yaml")
    done = rcgen(*values, "--dry-run", cwd=tmp_path)
    assert "upper'       skin" in done.stdout  # a body has its name
    done = rcgen(*values, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    scene = json.loads(
        (tmp_path / "world_simulator/world_simulator_generated/scene.json").read_text()
    )
    (skin,) = scene["scene"]["skins"]
    robot = read_robot(ARM, tmp_path / "arm.yaml")
    read, expected = geometry_of([Skin.of_data(skin)]), SkinGeometry.of(robot)
    assert read.ids.tolist() == expected.ids.tolist()
    assert read.limbs == expected.limbs == ("arm/limb",)
    assert np.allclose(read.points, expected.points, atol=1e-8)
    assert np.allclose(read.normals, expected.normals, atol=1e-8)
    assert read.sensitivities == expected.sensitivities
    assert lower_robot(robot)["limbs"] == skin["limbs"]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("body: upper", "body: uper"), "arm.yaml:7:13: error[RC824]"),
        (("joint: bend", "joint: bent"), "arm.yaml:5:9: error[RC822]"),
        (("[-1, 1]", "[-2, 1]"), "arm.yaml:5:9: error[RC823]"),
        (("gamma: 1", "gamma: 0"), "arm.yaml:5:9: error[RC821]"),
        (("parts:", "part:"), "arm.yaml:1:1: error[RC821]"),
        ((ARM[ARM.index("    skin:") :], ""), "no part has a `skin`"),
    ],
)
def test_tactile_description_mismatch_is_reported_with_position(
    tmp_path: Path, change: tuple[str, str], message: str
) -> None:
    (tmp_path / "world.xml").write_text(MJCF)
    (tmp_path / "arm.yaml").write_text(ARM.replace(*change))
    values = ("simulator", "world.xml", "--tactile", "arm.yaml", "--format", "concise")
    done = rcgen(*values, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (1, "")
    assert message in done.stderr
    assert not (tmp_path / "world_simulator").exists()


def test_tactile_description_that_is_missing_is_reported(tmp_path: Path) -> None:
    (tmp_path / "world.xml").write_text(MJCF)
    done = rcgen("simulator", "world.xml", "--tactile", "arm.yaml", cwd=tmp_path)
    assert done.returncode == 1
    assert "`arm.yaml` cannot be used: the file does not exist" in done.stderr
