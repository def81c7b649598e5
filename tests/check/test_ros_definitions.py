"""Where ROS definitions are found, and what is reported if they are not."""

from __future__ import annotations

import builtins
from importlib.metadata import PackageNotFoundError
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.check.passes import check_cdsl, check_idsl
from robocomp_dsl.check.workspace import ros_store
from robocomp_dsl.check.workspace.source_cache import SourceCache
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.interface import Module
from robocomp_dsl.model.types import ROS_PRIMITIVES, Struct
from robocomp_dsl.syntax.ros.definition import BUILT_IN


def put(folder: Path, name: str, field: str) -> None:
    """A definition whose only field has this name."""
    (folder / name).parent.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(f"int32 {field}\n")


def checked(text: str, folder: Path, workspace: Workspace) -> tuple[Module, Report]:
    path = folder / "Demo.idsl"
    path.parent.mkdir(exist_ok=True)
    path.write_text(text)
    report = Report()
    modules = check_idsl(path, workspace, report)
    assert modules
    return modules[-1], report


def first_field(name: str, folder: Path, workspace: Workspace) -> str:
    """The first field of the message that an import finds."""
    module, report = checked(f'import "{name}";\nmodule Demo {{ }};\n', folder, workspace)
    assert not report.has_errors, [finding.message for finding in report]
    (struct,) = module.imports[0].declarations
    assert isinstance(struct, Struct)
    return struct.fields[0].name


@pytest.fixture
def workspace(tmp_path: Path) -> Workspace:
    """Two import folders, two prefixes of ROS 2, two folders of ROS 1, shipped interfaces."""
    environ = {
        "ROBOCOMP_INTERFACES": f"{tmp_path / 'listed'}",
        "AMENT_PREFIX_PATH": f"{tmp_path / 'overlay'}:{tmp_path / 'underlay'}",
        "ROS_PACKAGE_PATH": f":{tmp_path / 'ros1'}",
    }
    return Workspace([tmp_path / "given"], environ, shipped=tmp_path / "shipped")


def test_ros_definition_is_found_in_first_folder(tmp_path: Path, workspace: Workspace) -> None:
    name, here = "demo_msgs/msg/Reading.msg", tmp_path / "here"
    folders = ["shipped", "ros1/stack", "ros1", "underlay/share", "overlay/share", "listed",
               "given/share", "given", "here"]  # fmt: skip
    for folder in folders:
        field = f"in_{folder.replace('/', '_')}"
        put(tmp_path / folder, name, field)
        assert first_field(name, here, workspace) == field


def test_ros_definition_is_found_in_folder_of_its_package(
    tmp_path: Path, workspace: Workspace
) -> None:
    put(tmp_path / "demo_msgs", "msg/Reading.msg", "reading")
    assert first_field("demo_msgs/msg/Reading.msg", tmp_path / "demo_msgs", workspace) == "reading"


def test_ros_definition_uses_its_neighbours_first(tmp_path: Path, workspace: Workspace) -> None:
    overlay, here = tmp_path / "overlay" / "share", tmp_path / "here"
    put(overlay, "demo_msgs/msg/Part.msg", "of_overlay")
    put(tmp_path / "given", "demo_msgs/msg/Part.msg", "of_given")
    (overlay / "demo_msgs/msg/Whole.msg").write_text("Part part\ndemo_msgs/Part other\n")
    text = 'import "demo_msgs/msg/Whole.msg";\nmodule Demo { };\n'
    module, report = checked(text, here, workspace)
    assert not report.has_errors
    (whole,) = module.imports[0].declarations
    assert isinstance(whole, Struct)
    assert whole.fields[0].type is whole.fields[1].type
    part = whole.fields[0].type
    assert isinstance(part, Struct)
    assert part.fields[0].name == "of_overlay"


def test_ros1_definition_names_types_without_package(tmp_path: Path, workspace: Workspace) -> None:
    (tmp_path / "ros1/old_msgs/msg").mkdir(parents=True)
    (tmp_path / "ros1/old_msgs/msg/Old.msg").write_text("Header header\ntime at\nduration d\n")
    text = 'import "old_msgs/Old.msg";\nmodule Demo { };\n'
    module, report = checked(text, tmp_path / "here", workspace)
    assert not report.has_errors, [finding.message for finding in report]
    (old,) = module.imports[0].declarations
    assert isinstance(old, Struct)
    names = [field.type.type_id for field in old.fields if isinstance(field.type, Struct)]
    assert names == [
        "std_msgs/msg/Header",
        "builtin_interfaces/msg/Time",
        "builtin_interfaces/msg/Duration",
    ]


def test_edited_ros_definition_is_read_again(tmp_path: Path, workspace: Workspace) -> None:
    name = "demo_msgs/msg/Reading.msg"
    put(tmp_path / "here", name, "first")
    assert first_field(name, tmp_path / "here", workspace) == "first"
    workspace.sources.set_overlay(tmp_path / "here" / name, "int32 edited\n")
    assert first_field(name, tmp_path / "here", workspace) == "edited"


def test_unknown_type_of_ros_package_suggests_its_import(tmp_path: Path) -> None:
    text = (
        "module Demo { struct S { sensor_msgs::LaserScan scan; std_srvs::Empty_Request e; }; };\n"
    )
    _, report = checked(text, tmp_path, Workspace(environ={}))
    fixes = [finding.fix.edits[0].text for finding in report if finding.fix]
    assert fixes == [
        'import "sensor_msgs/msg/LaserScan.msg";\n',
        'import "std_srvs/srv/Empty.srv";\n',
    ]


def test_messages_of_two_packages_with_one_name(tmp_path: Path, workspace: Workspace) -> None:
    for package in ("one_msgs", "two_msgs"):
        put(tmp_path / "here", f"{package}/msg/Reading.msg", package)
    text = (
        'import "one_msgs/msg/Reading.msg";\nimport "two_msgs/msg/Reading.msg";\n'
        "module Demo { struct S { one_msgs::Reading a; two_msgs::Reading b; }; };\n"
    )
    module, report = checked(text, tmp_path / "here", workspace)
    assert not report.sorted()
    (struct,) = module.declarations
    assert isinstance(struct, Struct)
    names = [field.type.type_id for field in struct.fields if isinstance(field.type, Struct)]
    assert names == ["one_msgs/msg/Reading", "two_msgs/msg/Reading"]


def test_component_does_not_import_ros_definitions(tmp_path: Path) -> None:
    path = tmp_path / "x.cdsl"
    path.write_text('import "std_msgs/msg/String.msg";\nComponent x { language Python; };\n')
    report = Report()
    check_cdsl(path, Workspace(environ={}), report)
    assert "RC207" in [finding.code.id for finding in report]


def test_builtin_types_of_parser_and_model_agree() -> None:
    assert set(ROS_PRIMITIVES) == BUILT_IN


@pytest.fixture
def without_rosbags(monkeypatch: pytest.MonkeyPatch) -> Any:
    """rosbags is not installed."""

    def no_version(name: str) -> str:
        raise PackageNotFoundError(name)

    imported = builtins.__import__

    def fail(name: str, *arguments: Any, **named: Any) -> Any:
        if name.startswith("rosbags"):
            raise ModuleNotFoundError(name=name)
        return imported(name, *arguments, **named)

    monkeypatch.setattr(builtins, "__import__", fail)
    monkeypatch.setattr(ros_store, "version", no_version)
    ros_store._typestore.cache_clear()
    yield
    ros_store._typestore.cache_clear()


@pytest.mark.usefixtures("without_rosbags")
def test_missing_ros_definition_names_rosbags_that_is_not_installed(tmp_path: Path) -> None:
    text = 'import "sensor_msgs/msg/LaserScan.msg";\nmodule Demo { };\n'
    _, report = checked(text, tmp_path, Workspace(environ={}))
    (finding,) = report
    assert finding.code.id == "RC222"
    assert "`pip install robocomp_dsl[ros]`" in finding.help


def test_definition_of_rosbags_without_cache_folder_is_virtual(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    files = SourceCache()
    path = ros_store.definition("std_msgs/msg/String.msg", files)
    assert path
    assert not path.exists()
    assert files.exists(path)
    assert files.read(path).text == "string data\n"
