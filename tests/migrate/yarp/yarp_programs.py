"""Two programs that speak YARP and know nothing of deployments: `speaker` and `listener`."""

from __future__ import annotations

from pathlib import Path

_PORT = """\
import os, signal, sys, time
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext

SCAN = rt.Interface(
    "Test::Scan", rt.Operation("ranges", rt.Pattern.PUBLISH, {"meters": rt.Float64Array})
)
name = sys.argv[1]
group = CallbackGroup()
context = ComponentContext(name, f"programs-{os.getpid()}", group, Statistics())
ports = open_ports("yarp", context)
at = Endpoint(SCAN, name, "Scan", middlewares=("yarp",))
signal.signal(signal.SIGTERM, lambda *_: os._exit(0))
"""
_SPEAKER = """\
publish = ports.advertise(at).bind(SCAN.operations[0])
while True:
    publish([1.5, 2.5])
    time.sleep(0.02)
"""
_LISTENER = """\
ports.subscribe(at, {"ranges": lambda meters: print("heard", list(map(float, meters)), flush=True)},
                group)
while True:
    time.sleep(60.0)
"""


def write_programs(folder: Path) -> None:
    """Write `speaker.py` with the port `/NAME/Scan:o`, and `listener.py` with `/NAME/Scan:i`."""
    (folder / "speaker.py").write_text(_PORT + _SPEAKER)
    (folder / "listener.py").write_text(_PORT + _LISTENER)
