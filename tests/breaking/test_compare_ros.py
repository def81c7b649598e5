"""Changes of ROS definitions that a compared IDSL file imports."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.breaking.compare import Version, compare
from robocomp_dsl.check.passes import check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report

USES = "interface I { [publish] void reading(demo_msgs::Reading reading); };"


def version(folder: Path, message: str, uses: str = USES) -> Version:
    """The models of an IDSL file that imports a message with this text."""
    (folder / "demo_msgs/msg").mkdir(parents=True)
    (folder / "demo_msgs/msg/Reading.msg").write_text(message)
    imported = 'import "demo_msgs/msg/Reading.msg";' if uses else ""
    (folder / "Demo.idsl").write_text(f"{imported}\nmodule Demo {{ {uses} }};\n")
    report, found = Report(), Version()
    found.add(check_idsl(folder / "Demo.idsl", Workspace(environ={}), report))
    assert not report.has_errors
    return found


def changes(old: Version, new: Version) -> list[str]:
    report = Report()
    compare(old, new, (), report)
    return [f"{finding.code.id}: {finding.message}" for finding in report.sorted()]


def test_changes_of_imported_ros_message_are_breaking(tmp_path: Path) -> None:
    old = version(tmp_path / "old", "uint16 width\nfloat64[9] c\nint32[] few [1]\nstring<=4 s\n")
    new = version(tmp_path / "new", "uint32 width\nfloat64[6] c\nint32[] few [2]\nstring<=5 s\n")
    assert changes(old, new) == [
        "RC641: `demo_msgs::Reading.width` was unsigned short, now unsigned int",
        "RC641: `demo_msgs::Reading.c` was double[9], now double[6]",
        "RC644: the default of `demo_msgs::Reading.few` was (1,), now (2,)",
        "RC641: `demo_msgs::Reading.s` was string<=4, now string<=5",
    ]
    assert changes(old, old) == []


def test_ros_message_that_is_no_longer_imported_is_no_change_itself(tmp_path: Path) -> None:
    unused = version(tmp_path / "old", "int32 x\n", "struct S { int a; };")
    dropped = version(tmp_path / "new", "int32 x\n", "")
    assert changes(unused, dropped) == ["RC641: struct `Demo::S` was removed"]
