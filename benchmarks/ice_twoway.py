"""Round trips of plain Ice: a pose there, a pose back, with the classes of slice2py.

    PYTHON ice_twoway.py serve             prints its proxy; until its input ends
    PYTHON ice_twoway.py call PROXY CALLS  for each line of its input, prints the median in us

Run by a Python that has Ice: Debian's, with `python3-zeroc-ice`. No import of this project.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from statistics import median
from time import perf_counter_ns

import Ice

SLICE = """
module Bench {
    struct Pose { double stamp; double x; double y; double z;
                  double qx; double qy; double qz; double qw; string frame; };
    interface Mover { Pose move(Pose value); };
};
"""


def load() -> object:
    """The module that slice2py generates."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "pose.ice"
        path.write_text(SLICE)
        Ice.loadSlice(f"--underscore {path}")
    import Bench  # noqa: PLC0415 - created by loadSlice

    return Bench


def serve(communicator, bench) -> None:
    """A servant, until the input ends."""

    class Mover(bench.Mover):
        def move(self, value, current=None):  # noqa: ARG002
            return value

    adapter = communicator.createObjectAdapterWithEndpoints("bench", "tcp -h 127.0.0.1")
    proxy = adapter.add(Mover(), Ice.stringToIdentity("mover"))
    adapter.activate()
    print(proxy, flush=True)
    sys.stdin.read()


def call(communicator, bench, proxy: str, calls: int) -> None:
    """One round for each line of the input."""
    mover = bench.MoverPrx.checkedCast(communicator.stringToProxy(proxy))
    pose = bench.Pose(*(0.5,) * 8, "base_frame")
    print("ready", flush=True)
    for _ in sys.stdin:
        took = []
        for _ in range(calls):
            start = perf_counter_ns()
            mover.move(pose)
            took.append(perf_counter_ns() - start)
        print(median(took) / 1000, flush=True)


if __name__ == "__main__":
    with Ice.initialize(["--Ice.Warn.Connections=0"]) as opened:
        module = load()
        if sys.argv[1] == "serve":
            serve(opened, module)
        else:
            call(opened, module, sys.argv[2], int(sys.argv[3]))
