"""Details of generated bridges: images, live parameters, and names that generated code uses."""

from __future__ import annotations

import inspect
import math
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.runtime.bridge.context import MessageContext
from tests.bridge.bridge_run import Peer, generate, load_worker, running
from tests.cli.rcgen_run import Rcgen
from tests.support.waiting import wait_until

Peers = Callable[..., Peer]
IMAGE = """
import "sensor_msgs/msg/Image.msg";

Bridge camera
{
    input eye : sensor_msgs::Image over zenoh at "source";
    output picture : sensor_msgs::Image over zenoh = eye { header.frame_id = "eye"; };
};
"""


def test_bridge_does_not_copy_image_and_keeps_received_message_unchanged(
    rcgen: Rcgen, tmp_path: Path, domain: str, peer: Peers
) -> None:
    folder = generate(rcgen, tmp_path, IMAGE)
    with running(folder, "--domain", domain) as worker:
        interface = type(worker.picture_proxy).INTERFACE
        image_type = interface.operations[0].inputs[0][1]
        received = next(port for port in worker.SPEC.subscribes if port.name == "eye").interface
        source = Peer("source", domain, "zenoh")
        push = source.publisher(received, "eye")
        heard = peer("zenoh", shares_domain=True).subscribe(interface, "p", "camera.picture")
        image = image_type(width=1000, height=1000, data=np.arange(10**6, dtype=np.uint8))
        wait_until(lambda: (push(image), heard)[1])
        assert heard[0].header.frame_id == "eye"
        assert np.array_equal(heard[0].data, image.data)
        bridge = worker.bridge
        eye, output = bridge.inputs["eye"], bridge.outputs["picture"]
        (message,) = output._build(output._context, worker, (eye.newest.value,))
        assert message.data is eye.newest.value.data
        assert eye.newest.value.header.frame_id == ""
        source.close()


SETTINGS = """
Bridge settings
{
    input a : double over zenoh;
    input b : double over zenoh;
    hub pair = a, b { policy synchronised within 33.3 ms; max_age 86400 s; };
    output joined : double[] over zenoh = pair { rate 33.3333333 Hz; };
    output fast : double over zenoh = a { rate 5000 Hz; };
};
"""


def test_live_parameters_of_bridge_have_its_values_and_change_it(
    rcgen: Rcgen, tmp_path: Path, domain: str
) -> None:
    folder = generate(rcgen, tmp_path, SETTINGS)
    assert rcgen("check", folder / "settings.pdsl", "--format", "concise").err == ""
    with running(folder, "--domain", domain, "--set", "fast.rate=0") as worker:
        bridge = worker.bridge
        assert bridge.schedule.rates == {"joined": 33.3333333, "fast": 0.0}
        assert worker._lifecycle.period_ms == pytest.approx(30.0)
        assert (bridge.hubs["pair"].tolerance_ns, bridge.hubs["pair"].max_age) == (
            33_300_000,
            86_400,
        )
        worker.params.set({"joined.rate": 0.0, "pair.tolerance": 0.5, "pair.max_age": 2.0})
        assert worker._lifecycle.period_ms == 0.0
        assert not bridge.outputs["joined"].is_scheduled
        assert (bridge.hubs["pair"].tolerance_ns, bridge.hubs["pair"].max_age) == (500_000_000, 2)


WORDS = (  # noqa: SIM905 - shorter
    "class lambda self at user values message np int list Any rt copy mapping bridge log"
    " initialize compute params get BridgeWorker JointState Time None object import field len"
).split()


def test_bridge_names_never_hide_names_of_generated_code(rcgen: Rcgen, tmp_path: Path) -> None:
    parts = "".join(
        f"input {word} : double[] [deg] over zenoh;\n"
        f"hub {word}_hub = {word};\n"
        f"function {word}_function(double[] {word} [rad]) -> double[] [rad];\n"
        f"output {word}_output : sensor_msgs::JointState over zenoh {{ header.stamp = now;"
        f" position = {word}_hub to [rad]; effort = {{ counter, length({word}) }}; }};\n"
        f"output {word}_called : double[] [rad] over zenoh = {word}_function({word});\n"
        for word in WORDS
    )
    text = f'import "sensor_msgs/msg/JointState.msg";\nBridge words {{\n{parts}}};\n'
    worker = load_worker(generate(rcgen, tmp_path, text))
    mapping = sys.modules["words_generated.mapping"]
    context = MessageContext(lambda _: 0)
    for word in WORDS:
        build = getattr(mapping, f"output_{word}_output")
        names = inspect.signature(build).parameters
        sets = [(np.array([180.0]),)] * (len(names) - 2)
        (message,) = build(context, worker(), *sets)
        assert message.position.tolist() == pytest.approx([math.pi])
        assert message.effort.tolist() == [0, 1]
        assert hasattr(worker, f"{word}_function")
