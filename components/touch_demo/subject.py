"""The robots that can be touched, and the paths of their files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.tactile.description.model import GenericPart
from robocomp_dsl.tactile.description.read import load_robot

HERE = Path(__file__).parent
RECORDINGS = HERE.parents[1] / "build" / "touch_demo"
PART = "left_arm"


@dataclass(frozen=True, slots=True)
class Subject:
    """A robot that can be touched: its name, its deployment and its world."""

    name: str
    ddsl: Path
    world: Path

    @property
    def part(self) -> GenericPart:
        """The arm that is touched, by the description beside the world."""
        return load_robot(self.world.with_name("tactile.yaml")).part(PART)

    @property
    def recording_path(self) -> Path:
        """Base name of its recording and its log."""
        return RECORDINGS / self.ddsl.stem


SUBJECTS = {
    key: Subject(name, HERE / f"{key}.ddsl", HERE.parent / f"{key}_simulator" / f"{key}.xml")
    for key, name in (("nao", "NAO"), ("icub", "iCub"))
}
