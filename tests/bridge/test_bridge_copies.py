"""Images and point clouds pass a generated bridge as they are: no lists, and no copy."""

from __future__ import annotations

import sys
import tracemalloc
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.bridge.bridge_run import generate, running
from tests.cli.rcgen_run import Rcgen

BYTES = 1 << 20
TEXT = """\
import "sensor_msgs/msg/Image.msg";
import "sensor_msgs/msg/PointCloud2.msg";

Bridge eyes
{
    input image : sensor_msgs::Image over zenoh;
    input cloud : sensor_msgs::PointCloud2 over zenoh;
    output view : sensor_msgs::Image over zenoh = image { header.frame_id = "eye"; };
    output scene : sensor_msgs::PointCloud2 over zenoh = cloud { header.stamp = now; };
    output bytes : byte[] over zenoh = image.data;
};
"""


@pytest.mark.parametrize(
    ("source", "outputs"), [("image", ("view", "bytes")), ("cloud", ("scene",))]
)
def test_bridge_passes_arrays_without_a_copy(
    rcgen: Rcgen, tmp_path: Path, domain: str, source: str, outputs: tuple[str, ...]
) -> None:
    folder = generate(rcgen, tmp_path, TEXT, "eyes.bdsl")
    with running(folder, "--domain", domain) as worker:
        bridge = worker.bridge
        sent: dict[str, Any] = {}
        for name in outputs:
            bridge.outputs[name]._publish = lambda value, name=name: sent.update({name: value})
        handler = bridge.inputs[source]
        message = _message(source)
        tracemalloc.start()
        handler.receive(message)
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        assert sent.keys() == set(outputs)
        for value in sent.values():
            data = value if isinstance(value, np.ndarray) else value.data
            assert isinstance(data, np.ndarray)
            assert data.dtype == np.uint8
            assert np.shares_memory(data, message.data)
        assert peak < BYTES // 4


def _message(source: str) -> Any:
    """A message of 1 MB, of the generated type."""
    found = vars(sys.modules["eyes_generated.interfaces"])[
        "Image" if source == "image" else "PointCloud2"
    ]
    message = found()
    message.data = np.zeros(BYTES, np.uint8)
    return message
