"""The summary of a drive, as numbers and text.

In: the recorded path, the room, two samples of every component's statistics. Out: a `Drive` for
the picture and lines for the terminal.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from picture import Drive

from robocomp_dsl.hardware.kinematics.planar import Pose
from robocomp_dsl.runtime.component.component_interface import OperationStatistics, Statistics
from robocomp_dsl.simulation.scene.floor_plan import Outline, clearance


@dataclass(frozen=True, slots=True)
class Look:
    """The statistics of the components by name, at `wall` (s) and at `simulated` (s)."""

    wall: float
    simulated: float
    statistics: Mapping[str, Statistics]


def read_drive(file: Path, room: Sequence[Outline], start: Pose, radius: float) -> Drive:
    """The first run in the CSV file of the path logger."""
    table = np.atleast_1d(np.genfromtxt(file, delimiter=",", names=True))
    table = table[table["run"] == 0]
    path = np.stack([table["x_mm"], table["z_mm"]], axis=1)
    wheels = np.stack([table[f"odometry_{name}"] for name in ("x_mm", "z_mm", "alpha_rad")], axis=1)
    poses = [start.then(Pose(*row)) for row in wheels.tolist()]
    distances, feet = clearance(path, room)
    nearest = int(distances.argmin())
    return Drive(
        time=table["time_s"],
        path=path,
        heading=table["alpha_rad"],
        odometry=np.array([(pose.x, pose.z) for pose in poses]),
        radius=radius,
        nearest=nearest,
        touching=feet[nearest],
        clearance=float(distances[nearest]) - radius,
    )


def length(drive: Drive) -> float:
    """The length of the path in mm."""
    return float(np.linalg.norm(np.diff(drive.path, axis=0), axis=1).sum())


def obstacle(drive: Drive, room: Sequence[Outline]) -> str:
    """The obstacle of the nearest approach."""
    place = drive.path[drive.nearest : drive.nearest + 1]
    name = min(room, key=lambda outline: float(clearance(place, (outline,))[0][0])).name
    kind, *rest = name.split(maxsplit=2)
    return rest[1] if len(rest) > 1 else kind


def speed(first: Look, last: Look) -> float:
    """The real-time factor."""
    return (last.simulated - first.simulated) / (last.wall - first.wall)


def lines(first: Look, last: Look, drive: Drive, room: Sequence[Outline]) -> Iterator[str]:
    """The summary."""
    seconds = last.wall - first.wall
    yield f"{last.simulated:.1f} s of simulated time, {speed(first, last):.3f} times real time"
    yield ""
    yield f"{'rates':<44}{'per second':>12}"
    for name in last.statistics:
        cycles = last.statistics[name].cycles - first.statistics[name].cycles
        if cycles:
            yield f"  {name + ' computes':<42}{cycles / seconds:>12.1f}"
    for label, component, operation in (
        ("laser scans, wander from mobile_base", "wander", "getLaserData"),
        ("speed commands, wander to mobile_base", "wander", "setSpeedBase"),
        ("base states, mobile_base to path_logger", "path_logger", "pushBaseState"),
    ):
        calls = _of(last, component, operation).calls - _of(first, component, operation).calls
        yield f"  {label:<42}{calls / seconds:>12.1f}"
    yield ""
    yield f"{'round trip of a query, ms':<44}{'median':>12}{'90 %':>9}{'99 %':>9}"
    for operation in ("getLaserData", "setSpeedBase"):
        it = _of(last, "wander", operation)
        yield f"  {operation:<42}{it.p50:>12.2f}{it.p90:>9.2f}{it.p99:>9.2f}"
    yield ""
    off = float(np.linalg.norm(drive.path[-1] - drive.odometry[-1]))
    when = float(drive.time[drive.nearest])
    yield f"{'driven':<44}{length(drive) / 1000:>12.2f} m"
    near = f"the {obstacle(drive, room)}, after {when:.1f} s"
    yield f"{'nearest obstacle':<44}{drive.clearance:>12.0f} mm   {near}"
    yield f"{'odometry at the end, off by':<44}{off:>12.0f} mm"


def _of(look: Look, component: str, operation: str) -> OperationStatistics:
    found = look.statistics[component].operations
    return next((o for o in found if o.operation == operation), OperationStatistics())
