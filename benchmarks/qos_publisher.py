"""A process that publishes a control topic beside a saturating image stream.

python -m benchmarks.qos_publisher DOMAIN MIDDLEWARE: for each line `PORT SECONDS` of its input it
publishes at 100 Hz on that port, then prints the number of messages; it ends with its input.
"""

from __future__ import annotations

import sys
import threading
import time

import numpy as np

from benchmarks.camera_frames import CAMERA, CameraProxy
from benchmarks.pose_interface import TRACK, Pose, TrackProxy
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import ComponentContext

PERIOD_S = 0.01
IMAGE_BYTES = 900_000
PORTS = {"Plain": Qos(), "Urgent": Qos(priority="realtime")}


def main(domain: str, middleware: str, *names: str) -> None:
    """Publish until the end of the input; `names` are the control ports."""
    only = (middleware,)
    context = ComponentContext("source", domain, CallbackGroup(), Statistics())
    ports = open_ports(middleware, context, used=only)
    camera = CameraProxy(ports.advertise(Endpoint(CAMERA, "source", "Camera", middlewares=only)))
    control = {
        name: TrackProxy(ports.advertise(Endpoint(TRACK, "source", name, (), PORTS[name], only)))
        for name in names
    }
    pixels = np.zeros(IMAGE_BYTES, np.uint8)

    ended = threading.Event()

    def publish_images() -> None:
        while not ended.is_set():
            camera.taken(time.monotonic_ns(), pixels)

    camera.wait_for_server(60)
    images = threading.Thread(target=publish_images, daemon=True)
    images.start()
    print("ready", flush=True)
    for text in sys.stdin:
        name, seconds = text.split()
        count = round(float(seconds) / PERIOD_S)
        due = time.monotonic()
        for _ in range(count):
            control[name].moved(Pose(stamp=time.monotonic()))
            due += PERIOD_S
            time.sleep(max(0.0, due - time.monotonic()))
        print(count, flush=True)
    ended.set()
    images.join()
    ports.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
