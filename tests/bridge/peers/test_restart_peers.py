"""Programs on either side of a bridge, and their name services, end and start again."""

from __future__ import annotations

import re
import time

import pytest

from tests.bridge.peers import rover
from tests.bridge.peers.running_rover import Programs, Rover
from tests.middleware.ros1.ros1_peers import Master, needs_ros1
from tests.middleware.yarp.yarp_tools import Tools, needs_yarp
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_ros1, needs_yarp]


def test_bridge_reads_a_restarted_yarp_writer(running: Rover, yarp_program: Programs) -> None:
    running.writer.kill()
    warning = f"/rover/wheels:i is not connected to {rover.WHEELS}: "
    wait_until(lambda: warning in running.log(), running.log)
    writer = yarp_program("write", rover.WHEELS, [180.0, 45.0])
    wait_until(lambda: running.last_angle() == 180.0, running.log)
    rover.report_time("YARP writer", writer.ready_at)
    assert f"/rover/wheels:i is connected to {rover.WHEELS}" in running.finish()


@pytest.mark.parametrize("kind", ["reader", "RPC server"])
def test_bridge_writes_to_a_restarted_yarp_reader(
    running: Rover, yarp_program: Programs, kind: str
) -> None:
    is_reader = kind == "reader"
    name, port = ("command", rover.COMMAND) if is_reader else ("setting", rover.SETTING)
    (running.reader if is_reader else running.server).kill()
    wait_until(lambda: "until there is one, messages are lost" in running.log(), running.log)
    for _ in range(5):  # what the reader does not get
        running.publisher.command("publish", rover.SPEED, {"data": -1.0})
    running.publisher.command("stop", rover.SPEED)
    running.publisher.command("stream", rover.SPEED, {"data": 0.25}, 0.02)
    other = running.server if is_reader else running.reader
    wait_until(lambda: other.messages[-1][1].endswith(" 0.25"), running.log)
    program = yarp_program(*(("read", port) if is_reader else ("serve", port, ["ok"])))
    wait_until(lambda: program.messages, running.log)
    rover.report_time(f"YARP {kind}", program.ready_at, lambda: program.times[1])
    assert program.messages[0][1].endswith(" 0.25")  # nothing that is out of date
    log = running.finish()
    (lost,) = re.findall(rf"/rover/{name}:o is connected to {port}; .* meanwhile: (\d+)", log)
    assert int(lost) >= 6
    (total,) = re.findall(rf"output `{name}`: .* (\d+) lost by the middleware", log)
    assert int(total) >= int(lost)


def test_bridge_joins_restarted_ros_nodes(running: Rover) -> None:
    running.subscriber.close()
    running.subscriber = running.start_subscriber()
    begun = time.monotonic()
    wait_until(lambda: running.subscriber.command("count", rover.ANGLES), running.log)
    rover.report_time("rospy subscriber", begun)
    running.publisher.close()
    ended = f"{rover.SPEED}: the publisher /publisher ended"
    wait_until(lambda: ended in running.log(), running.log)
    running.publisher = running.start_publisher(0.75)
    begun = time.monotonic()
    wait_until(lambda: running.last_command() == "speed 0.75", running.log)
    rover.report_time("rospy publisher", begun)
    assert f"{rover.SPEED} is connected to /publisher" in running.finish()


def test_bridge_continues_when_yarpserver_restarts(
    running: Rover, yarp: Tools, yarp_program: Programs
) -> None:
    yarp.stop_name_server()
    lost = "the name server of YARP cannot be reached"
    wait_until(lambda: lost in running.log(), running.log)
    running.wait_for_more()  # connections do not need it
    yarp.start_name_server()
    begun = time.monotonic()
    wait_until(lambda: yarp.knows("/rover/wheels:i"), running.log)
    rover.report_time("yarpserver: ports registered again", begun)
    running.wait_for_more()
    # The restarted server knows no ports of programs that were not restarted.
    running.writer.kill()
    running.reader.kill()
    writer = yarp_program("write", rover.WHEELS, [180.0, 45.0])
    running.reader = yarp_program("read", rover.COMMAND)
    wait_until(lambda: running.last_angle() == 180.0, running.log)
    rover.report_time("yarpserver and YARP writer", writer.ready_at)
    wait_until(lambda: running.reader.messages, running.log)
    begun, found = running.reader.times[:2]
    rover.report_time("yarpserver and YARP reader", begun, lambda: found)
    log = running.finish()
    assert "the name server of YARP replies" in log
    assert "yarpserver" in log  # how to start it


def test_bridge_continues_when_rosmaster_restarts(running: Rover, master: Master) -> None:
    master.stop()
    wait_until(lambda: "Start the master with `roscore`" in running.log(), running.log)
    running.wait_for_more()  # connections do not need it
    master.start()
    begun = time.monotonic()
    wait_until(lambda: master.nodes_of(0, rover.ANGLES), running.log)
    wait_until(lambda: master.nodes_of(1, rover.SPEED), running.log)
    rover.report_time("rosmaster: topics registered again", begun)
    # The restarted master knows no nodes of rospy that were not restarted.
    running.subscriber.close()
    running.publisher.close()
    running.subscriber = running.start_subscriber()
    begun = time.monotonic()
    wait_until(lambda: running.subscriber.command("count", rover.ANGLES), running.log)
    rover.report_time("rosmaster and subscriber", begun)
    running.start_publisher(0.75)
    begun = time.monotonic()
    wait_until(lambda: running.last_command() == "speed 0.75", running.log)
    rover.report_time("rosmaster and publisher", begun)
    assert f"the ROS master {master.uri} replies" in running.finish()
