"""The simulators of the robots that ship, as processes: a client moves an arm and the finger."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from robocomp_dsl.resources import INTERFACES
from tests.simulation.served_worlds import CLIENT, run

COMPONENTS = Path(INTERFACES).parent / "components"

BODY = """
import subprocess
process = subprocess.Popen([sys.executable, "main.py", "--domain", sys.argv[2]])
try:
    arm, finger = proxy(i.CONTROLBOARD, sys.argv[4]), proxy(i.CONTROLBOARD, "finger")
    joint, goal = sys.argv[5], float(sys.argv[6])
    names = [joint.name for joint in arm.getJoints()]
    at = names.index(joint)
    assert [joint.name for joint in finger.getJoints()] == ["finger_x", "finger_y", "finger_z"]
    assert all(joint.prismatic and joint.torqueLimit == 20.0 for joint in finger.getJoints())
    refusal_of(i.UnknownJoint, arm.positionMove, ["finger_x"], [0.1])
    rest = arm.getState().position.copy()
    arm.setReferenceSpeed([joint], [1.0])
    arm.positionMove([joint], [goal])
    wait_until(lambda: abs(arm.getState().position[at] - goal) < 0.01)
    others = [k for k in range(len(names)) if k != at]
    wait_until(lambda: abs(arm.getState().position[others] - rest[others]).max() < 0.02)
    start = finger.getState().position.copy()
    finger.setReferenceSpeed([], [0.3, 0.3, 0.3])
    finger.positionMove([], start + (0.05, 0.1, -0.15))
    wait_until(lambda: abs(finger.getState().position - start - (0.05, 0.1, -0.15)).max() < 2e-3)
    nodes = proxy(i.INNERMODELMANAGER, "InnerModelManager")
    def agree():  # it may still be coming to rest between the two questions
        place, slides = nodes.getPose("root", "finger")[1], finger.getState().position
        return abs(place.x - 1000 * slides[0]) < 1 and abs(place.y - 1000 * slides[2]) < 1
    wait_until(agree)
    motors = proxy(i.JOINTMOTOR, "JointMotor")
    wait_until(lambda: abs(motors.getMotorState(joint).pos - goal) < 0.02)
    states = []
    source = (sys.argv[3] + "." + sys.argv[4] + "_pub",)
    topic = Endpoint(i.ControlBoardStateProxy.INTERFACE, "client", "x", source)
    middleware.subscribe(topic, {"boardState": states.append}, CallbackGroup())
    wait_until(lambda: states and abs(states[-1].position[at] - goal) < 0.02)
    hand = proxy(i.CARTESIANCONTROLLER, "cartesian_" + sys.argv[4])
    place = hand.getPose().place
    solved = hand.askForPosition(i.HandPlace(place.x, place.y, place.z + 0.03))
    hand.goToPose(solved.pose, 0.5)
    wait_until(hand.checkMotionDone)
    wait_until(lambda: abs(hand.getPose().place.z - place.z - 0.03) < 4e-3)
    assert hand.getState().motion is i.MotionState.Reached
    far = refusal_of(i.Unreachable, hand.goToPosition, i.HandPlace(9.0, 0.0, 0.0), 0.5)
    assert 7.0 < far.distance < 10.0
    arm.setControlMode([], i.ControlMode.Position)
    world = proxy(i.SIMULATION, "Simulation")
    world.reset()
    wait_until(lambda: abs(arm.getState().position[at] - rest[at]) < 1e-3)
    print("moved")
except BaseException:
    traceback.print_exc()
    process.kill()
    os._exit(1)
process.terminate()
assert process.wait(60) == 0
middleware.close()
"""

ROBOTS = {
    "nao_simulator": ("LArm", "LElbowRoll", -1.2),
    "icub_simulator": ("left_arm", "l_elbow", 1.3),
}


@pytest.mark.parametrize("name", ROBOTS)
def test_robot_simulator_client_moves_arm_and_finger(name: str, tmp_path: Path) -> None:
    folder = tmp_path / name
    shutil.copytree(COMPONENTS / name, folder, ignore=shutil.ignore_patterns("__pycache__"))
    board, joint, goal = ROBOTS[name]
    domain = f"test-{tmp_path.name}"
    message = run(folder, CLIENT + BODY, "zenoh", domain, name, board, joint, str(goal))
    assert message == "moved\n"
