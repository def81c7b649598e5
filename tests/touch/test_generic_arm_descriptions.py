"""Descriptions that `generic_arm` is started with."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.waiting import wait_until
from tests.touch.arm_client import ARM, DESCRIPTIONS, GOAL, NONE, arm_on, refusal_of

SERVO = """
  <generic_servo id="{index}">
    <destination_servo_id>{joint}</destination_servo_id>
    <transform_factor>{gamma}</transform_factor>
    <transform_displacement>{sigma}</transform_displacement>
    <speed>4.0</speed>
    <limits min="-3" max="3"/>
  </generic_servo>"""


def test_generic_arm_runs_with_xml_listing(tmp_path: Path) -> None:
    """Joints by their numbers on the board, two servos left out, and its misspelt tag."""
    servos = "".join(
        SERVO.format(index=index, joint=joint, gamma=gamma, sigma=sigma)
        for index, joint, gamma, sigma in ((0, 0, -1, 1.5708), (1, 1, 1, 0), (3, 3, -1, 0))
    )
    (tmp_path / "arm.xml").write_text(
        f"""<Generic_Robot_Part>left_arm</Generic_Robot_Part>
<generic_servo_number>5</generic_servo_number>{servos}
<initial_positions>
  <servo type="rad" destination_servo_id="3" pos="-0.6"/>
  <servo type="rad" destination_servo_id="5" pos="0.4"/>
</initial_postions>"""
    )
    with arm_on("nao_h25", description=tmp_path / "arm.xml") as (arm, served):
        limits = arm.getLimits()
        assert limits.available.tolist() == [True, True, False, True, False]
        assert "no kinematic chain" in refusal_of(arm.getChain)
        outcome = arm.move(GOAL, NONE)
        assert outcome.dropped.tolist() == [False, False, True, False, True]
        assert arm.wait_for_rest().position == pytest.approx([0.5, 0.6, 0, 0.9, 0], abs=0.05)
        hand = served.part.board.spec.names.index("LHand")
        wait_until(lambda: abs(served.part.board.position[hand] - 0.4) < 0.03)


NAO = DESCRIPTIONS / "nao_h25.yaml"

WRONG = {
    "part": ([f"description={NAO}", "part=left_leg"], ("nao_h25.yaml:", "left_arm, right_arm")),
    "near": ([f"description={NAO}", "part=left_arn"], ("did you mean `left_arm`?",)),
    "file": (["description=nobody.yaml"], ("file not found: `nobody.yaml`", "etc/nobody.yaml")),
    "folder": ([f"description={DESCRIPTIONS}"], ("file not found",)),
    "fault": (["description=FAULTY"], ("faulty.yaml:10:51", "did you mean `gamma`?")),
    "bytes": (["description=BYTES"], ("bytes.yaml:1:1", "not UTF-8 text")),
    "boards": (["description=SPREAD"], ("on 5 physical parts", "ports for 3")),
}


def write_descriptions(folder: Path) -> dict[str, Path]:
    text = NAO.read_text()
    (folder / "faulty.yaml").write_text(text.replace(" gamma: -1", " gama: -1", 1))
    (folder / "bytes.yaml").write_bytes(b"\xff\xfe\x00")
    spread, number = "", 0
    for line in text.splitlines(keepends=True):
        number += "gamma" in line and "part: LArm" in line
        spread += line.replace("part: LArm", f"part: piece{number}")
    (folder / "spread.yaml").write_text(spread)
    return {name.upper(): folder / f"{name}.yaml" for name in ("faulty", "bytes", "spread")}


@pytest.mark.parametrize("case", WRONG)
def test_generic_arm_exits_with_position_of_wrong_description(case: str, tmp_path: Path) -> None:
    settings, words = WRONG[case]
    files = write_descriptions(tmp_path)
    options = []
    for setting in settings:
        key, _, value = setting.partition("=")
        options += ["--set", f"{key}={files.get(value, value)}"]
    done = subprocess.run(
        [sys.executable, "main.py", "--domain", f"wrong-{tmp_path.name}", *options],
        cwd=ARM.folder,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 1
    for word in words:
        assert word in done.stderr
    assert "Traceback" not in done.stderr
    assert "finalize" not in done.stderr
    assert "ConfigError" not in done.stderr
