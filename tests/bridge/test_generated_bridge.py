"""Generated bridges: data from YARP ports to topics and services of other middlewares."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.runtime import publishing_stamp
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.middleware.yarp.name_server import NameServer
from tests.bridge.bridge_run import NUMBERS, Peer, generate, running
from tests.cli.rcgen_run import Rcgen
from tests.support.waiting import wait_until

Peers = Callable[..., Peer]
pytestmark = pytest.mark.usefixtures("name_server")
SLICE = """
/** Angles of the rover. */
Bridge rover
{
    input left : double[] [deg] over yarp at "/rover/left:o";
    output angles : double[] [rad] over yarp at "/viewer:i" = left;
    output topic : double[] [rad] over zenoh = left;
};
"""


def test_bridge_passes_data_from_yarp_to_yarp_and_zenoh(
    rcgen: Rcgen, tmp_path: Path, domain: str, peer: Peers
) -> None:
    folder = generate(rcgen, tmp_path, SLICE)
    push = peer("yarp", source="/rover/left:o").publisher(NUMBERS, "source")
    seen = peer("yarp", viewer="/viewer:i").subscribe(NUMBERS, "viewer")
    with running(folder, "--domain", domain) as worker:
        interface = type(worker.topic_proxy).INTERFACE
        heard = peer("zenoh", shares_domain=True).subscribe(interface, "topic", "rover.topic")

        def arrived() -> bool:
            push(np.array([90.0, 180.0]))
            return bool(seen and heard)

        wait_until(arrived)
        expected = [math.pi / 2, math.pi]
        assert seen[0].tolist() == pytest.approx(expected)
        assert heard[0].tolist() == pytest.approx(expected)
        assert worker.bridge.outputs["angles"].counts.messages > 0


HUBS = """
import "sensor_msgs/msg/JointState.msg";

Bridge states
{
    input left : double[] [deg] over yarp at "/left:o";
    input right : double[1] [deg] over yarp at "/right:o";
    input gaze : (double x [mm], string name) over yarp at "/gaze:o";
    function mirror(double[] values [rad]) -> double[] [rad];
    hub wheels = left, right;
    output message : sensor_msgs::JointState over zenoh
    {
        header.stamp = stamp(left);
        header.frame_id = "rover";
        name = { gaze.name, "b", text(gaze.x) };
        position = mirror(wheels to [rad]) to [rad];
        velocity = wheels[1,0] to [deg];
        effort = { gaze.x to [m], counter };
    };
};
"""
MIRROR = """
    def mirror(self, values):
        if values[0] > 3:
            raise ValueError("too far")
        return -values
"""


def line_of(text: str, part: str) -> int:
    """The number of the line that contains `part`."""
    return next(n for n, line in enumerate(text.splitlines(), 1) if part in line)


class Gaze(rt.Struct):
    x: rt.Double = 0.0
    name: rt.String = ""


GAZE = rt.Interface("Test::Gaze", rt.Operation("at", rt.Pattern.PUBLISH, {"gaze": Gaze}))


def test_bridge_builds_ros_message_from_hubs_functions_and_stamps(
    rcgen: Rcgen, tmp_path: Path, domain: str, peer: Peers, caplog: pytest.LogCaptureFixture
) -> None:
    folder = generate(rcgen, tmp_path, HUBS)
    worker_file = folder / "specificworker.py"
    text = worker_file.read_text()
    head = text[: text.index("    def mirror")].rstrip() + "\n"
    worker_file.write_text(head + MIRROR)
    pushes = [
        peer("yarp", **{port: f"/{port}:o"}).publisher(interface, port)
        for port, interface in (("left", NUMBERS), ("right", NUMBERS), ("gaze", GAZE))
    ]
    with running(folder, "--domain", domain) as worker:
        interface = type(worker.message_proxy).INTERFACE
        heard = peer("zenoh", shares_domain=True).subscribe(interface, "message", "states.message")

        def push(left: list[float], right: list[float]) -> None:
            with publishing_stamp(1_700_000_000_250_000_000):
                pushes[0](np.array(left))
            pushes[1](np.array(right))
            pushes[2](Gaze(1500.0, "eye"))

        def arrived() -> bool:
            push([90.0], [180.0])
            return bool(heard)

        wait_until(arrived)
        message = heard[0]
        assert message.name == ["eye", "b", "1500.0"]
        assert message.header.frame_id == "rover"
        assert (message.header.stamp.sec, message.header.stamp.nanosec) == (
            1_700_000_000,
            250_000_000,
        )
        assert message.position.tolist() == pytest.approx([-math.pi / 2, -math.pi])
        assert message.velocity.tolist() == [180.0, 90.0]
        assert message.effort[0] == 1.5
        counts = worker.bridge.outputs["message"].counts
        wait_until(lambda: (push([200.0], [1.0]), counts.dropped)[1])
        found = re.search(r"position: ValueError: too far \(.*worker.py:(\d+)\)", caplog.text)
        assert found is not None
        assert "too far" in worker_file.read_text().splitlines()[int(found[1]) - 1]
        assert f"(x.bdsl:{line_of(HUBS, 'position =')})" in caplog.text
        lost = worker.bridge.inputs["right"].counts
        wait_until(lambda: (push([1.0], [1.0, 2.0]), lost.dropped)[1])
        place = f"x.bdsl:{line_of(HUBS, 'input right')}"
        assert f"input `right`: dropped: takes 1 item, not 2 ({place})" in caplog.text
        heard.clear()
        wait_until(lambda: (push([1.0], [2.0]), heard)[1])


RANGE = """
import "sensor_msgs/msg/Image.msg";

Bridge image
{
    input pixels : int[] over yarp at "/pixels:o";
    output picture : sensor_msgs::Image over zenoh
    {
        height = number(pixels[1]);
        data = number(pixels);
    };
};
"""


def test_bridge_drops_message_with_value_out_of_range_and_names_field(
    rcgen: Rcgen, tmp_path: Path, domain: str, peer: Peers, caplog: pytest.LogCaptureFixture
) -> None:
    generate(rcgen, tmp_path, RANGE)
    push = peer("yarp", pixels="/pixels:o").publisher(INTEGERS, "pixels")
    with running(tmp_path, "--domain", domain) as worker:
        interface = type(worker.picture_proxy).INTERFACE
        heard = peer("zenoh", shares_domain=True).subscribe(interface, "p", "image.picture")
        wait_until(lambda: (push(np.array([1, 255], np.int32)), heard)[1])
        assert (heard[0].height, heard[0].data.tolist()) == (255, [1, 255])
        counts = worker.bridge.outputs["picture"].counts
        for numbers, field, reason in (
            ([1, 256], "data", "item 1: 256.0 does not fit (0 to 255)"),
            ([1, -1], "height", "-1.0 does not fit (0 to 4294967295)"),
        ):
            place = f"x.bdsl:{line_of(RANGE, f'{field} =')}"
            text = f"output `picture`: not sent: {field}: {reason} ({place})"
            message = np.array(numbers, np.int32)
            wait_until(
                lambda message=message, text=text: (push(message), text in caplog.text)[1],  # type: ignore[misc]
                lambda: caplog.text,
            )
        assert counts.dropped.keys() == {"a value does not fit"}


INTEGERS = rt.Interface(
    "Test::Integers", rt.Operation("push", rt.Pattern.PUBLISH, {"numbers": rt.Int32Array})
)
SERVICE = """
import "DifferentialRobot.idsl";
import "std_srvs/srv/SetBool.srv";

Bridge switch
{
    service enable : std_srvs::SetBool over zenoh
    {
        call base : RoboCompDifferentialRobot::DifferentialRobot.setSpeedBase over zenoh at "base"
        {
            adv = number(request.data) * 200;
            rot = 0;
        };
        success = true;
        message = "set";
    };
};
"""


def test_bridge_service_calls_other_service_and_builds_reply(
    rcgen: Rcgen, tmp_path: Path, domain: str, peer: Peers
) -> None:
    folder = generate(rcgen, tmp_path, SERVICE)
    with running(folder, "--domain", domain) as worker:
        robot = type(worker.base_proxy).INTERFACE
        own = next(port for port in worker.SPEC.implements if port.name == "enable").interface
        speeds: list[tuple[float, float]] = []
        base = Peer("base", domain, "zenoh")
        handlers = {o.name: lambda *_: None for o in robot.operations}
        handlers["setSpeedBase"] = lambda adv, rot: speeds.append((adv, rot))
        base.ports.serve(base.endpoint(robot, "base"), handlers, base.group)
        caller = peer("zenoh", shares_domain=True)
        call = caller.ports.proxy(caller.endpoint(own, "enable", "switch.enable")).bind(
            own.operations[0]
        )
        request = own.operations[0].inputs[0][1]
        reply = wait_until(lambda: call(request(data=True)), ignoring=rt.MiddlewareError)
        assert (reply.success, reply.message) == (True, "set")
        assert speeds[-1] == (200.0, 0.0)
        base.close()
        with pytest.raises(rt.MiddlewareError):
            call(request(data=True))
        assert worker.bridge.services["enable"].counts.dropped.total() == 1


def test_bridge_continues_within_two_seconds_after_restart_of_yarp_program(
    rcgen: Rcgen, tmp_path: Path, domain: str, peer: Peers, name_server: NameServer
) -> None:
    folder = generate(rcgen, tmp_path, SLICE)
    seen = peer("yarp", viewer="/viewer:i").subscribe(NUMBERS, "viewer")
    with running(folder, "--domain", domain):
        for _ in range(2):
            source = Peer("source", f"{domain}-source", "yarp", addresses={"s": "/rover/left:o"})
            push = source.publisher(NUMBERS, "s")
            seen.clear()
            wait_until(lambda push=push: (push(np.ones(1)), seen)[1])  # type: ignore[misc]
            source.close()
