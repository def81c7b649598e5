"""Two generated components for the benchmark of groups: `driver` calls `mover` and measures."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.write import write

FILES = {
    "Bench.idsl": """
module Bench
{
    struct Pose { double x; double y; double z; double rx; double ry; double rz; long sent; };
    interface Mover
    {
        [query] Pose move(Pose pose);
        [command] void go(Pose pose);
        [query] double delay();
    };
    interface Track { [publish] void moved(Pose pose); };
    interface Rounds { [query] double once(string kind, int count); };
};
""",
    "mover/mover.cdsl": """
import "Bench.idsl";
Component mover
{
    Communications { implements Mover; subscribesTo Track; };
    language Python;
    period 0;
};
""",
    "driver/driver.cdsl": """
import "Bench.idsl";
Component driver
{
    Communications { requires Mover; publishes Track; implements Rounds; };
    language Python;
    period 0;
};
""",
    "app.ddsl": """
import "mover/mover.cdsl";
import "driver/driver.cdsl";

group pair
{
    component mover;
    component driver { after mover; };
};
group local_pair
{
    component mover;
    component driver { after mover; };
    connect driver.Mover -> mover.Mover over local;
    connect driver.Track -> mover.Track over local;
};
Deployment bench
{
    group zenoh : pair;
    group local : local_pair;
    group inprocess_ : pair { inprocess; };
};
""",
}
MOVER = """
from __future__ import annotations
from statistics import median
from time import monotonic_ns
from mover_generated.genericworker import GenericWorker
from mover_generated.interfaces import *

class SpecificWorker(GenericWorker):
    delays: list[int] = []

    def Mover_move(self, pose: Pose) -> Pose:
        return pose

    def Mover_go(self, pose: Pose) -> None:
        self.delays.append(monotonic_ns() - pose.sent)

    def Track_moved(self, pose: Pose) -> None:
        self.delays.append(monotonic_ns() - pose.sent)

    def Mover_delay(self) -> float:
        found = median(self.delays) / 1000 if self.delays else 0.0
        self.delays.clear()
        return found
"""
DRIVER = """
from __future__ import annotations
from statistics import median
from time import monotonic_ns, perf_counter_ns, sleep
from driver_generated.genericworker import GenericWorker
from driver_generated.interfaces import *

class SpecificWorker(GenericWorker):
    def Rounds_once(self, kind: str, count: int) -> float:
        if kind == "query":
            return self.queries(count)
        send = self.mover_proxy.go if kind == "command" else self.track_proxy.moved
        for _ in range(count):
            send(Pose(1.0, 2.0, 3.0, 0.1, 0.2, 0.3, monotonic_ns()))
            sleep(0.001)
        return self.mover_proxy.delay()

    def queries(self, count: int) -> float:
        pose, took = Pose(1.0, 2.0, 3.0, 0.1, 0.2, 0.3, 0), []
        for _ in range(count):
            start = perf_counter_ns()
            self.mover_proxy.move(pose)
            took.append(perf_counter_ns() - start)
        return median(took) / 1000
"""


def write_components(folder: Path) -> Path:
    """Generate both below `folder`; returns the path of their deployment."""
    for name, text in FILES.items():
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    for name, worker in (("mover", MOVER), ("driver", DRIVER)):
        report = Report()
        component = check_cdsl(folder / name / f"{name}.cdsl", Workspace([folder]), report)
        if component is None or report.has_errors:
            raise RuntimeError("; ".join(found.message for found in report))
        write(folder / name, plan(component))
        (folder / name / "specificworker.py").write_text(worker)
    return folder / "app.ddsl"
