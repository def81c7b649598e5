"""The search for a configuration: precedence, folders, and the message when there is none."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from robocomp_dsl.runtime.config import (
    ConfigRequest,
    ConfigResult,
    SearchEnvironment,
    resolve_config,
)
from robocomp_dsl.runtime.parameters import ConfigError
from tests.runtime.search_folders import SearchFolders

ORDER = [
    "work/{}",
    "work/etc/{}",
    "work/robots/twin/{}",
    "user/config/robots/twin/{}",
    "user/data/robots/twin/{}",
    "admin/robots/twin/{}",
    "share1/robots/twin/{}",
    "share2/robots/twin/{}",
    "dropped/robots/twin/{}",
    "work/contexts/lab/{}",
    "user/config/contexts/lab/{}",
    "user/data/contexts/lab/{}",
    "admin/contexts/lab/{}",
    "share1/contexts/lab/{}",
    "share2/contexts/lab/{}",
    "dropped/contexts/lab/{}",
    "user/config/{}",
    "user/data/{}",
    "admin/{}",
    "share1/{}",
    "share2/{}",
    "dropped/{}",
]
"""The whole search for a file of `--config-name`, with the robot `twin` and the context `lab`."""


@pytest.fixture
def folders(tmp_path: Path) -> SearchFolders:
    search_folders = SearchFolders(tmp_path)
    search_folders.environment["ROBOCOMP_ROBOT_NAME"] = "twin"
    search_folders.put(
        "share2/path.d/more.conf", "# folder of another package\n\n../../dropped  # here\n"
    )
    return search_folders


def resolve(folders: SearchFolders, context: str = "", file: str = "", *names: str) -> ConfigResult:
    return resolve_config(
        ConfigRequest(context, file, names),
        SearchEnvironment.from_environ(folders.environment, folders.work),
    )


def test_resolve_config_searches_folders_in_order(folders: SearchFolders) -> None:
    """Every folder has the file; the test removes each match in turn."""
    files = [folders.put(place.format("arm.yaml")) for place in ORDER]
    for file in files:
        found = resolve(folders, "lab", "arm.yaml")
        assert found.path is not None
        assert found.path.resolve() == file
        file.unlink()
    with pytest.raises(ConfigError) as caught:
        resolve(folders, "lab", "arm.yaml")
    lines = str(caught.value).splitlines()
    assert lines[:4] == [
        "error: configuration not found: `arm.yaml`",
        "  --> --config-name:1:1",
        "   |",
        " 1 | arm.yaml",
    ]
    listed = [line.split(" (")[0].strip() for line in lines if line.endswith(": not found")]
    assert [str(Path(os.path.normpath(place))) for place in listed] == [str(f) for f in files]


@pytest.mark.parametrize(
    ("there", "winner"),
    [
        (["share1/contexts/lab/arm.yaml"], "share1/contexts/lab/arm.yaml"),
        (
            ["share1/contexts/lab/arm.yaml", "user/data/contexts/lab/arm.yaml"],
            "user/data/contexts/lab/arm.yaml",
        ),
        # The best matching name takes precedence over the owner of the folder.
        (
            ["share1/contexts/lab/left-arm.yaml", "user/data/contexts/lab/arm.yaml"],
            "share1/contexts/lab/left-arm.yaml",
        ),
        (["user/data/contexts/lab/config.yaml"], "user/data/contexts/lab/config.yaml"),
        (["share1/contexts/lab/arm.toml"], "share1/contexts/lab/arm.toml"),
        # Only the context is searched; other folders do not count.
        (["work/arm.yaml", "user/data/arm.yaml", "share1/contexts/other/arm.yaml"], None),
        ([], None),
    ],
)
def test_resolve_config_in_context_without_file_name(
    folders: SearchFolders, there: list[str], winner: str | None
) -> None:
    for path in there:
        folders.put(path)
    found = resolve(folders, "lab", "", "left-arm", "arm")
    assert found.path == (folders.top / winner if winner else None)


def test_resolve_config_skips_folder_with_file_name(folders: SearchFolders) -> None:
    (folders.work / "arm.yaml").mkdir()
    below = folders.put("share1/arm.yaml")
    found = resolve(folders, "", "arm.yaml")
    assert found.path == below
    assert found.candidates[0].skip_reason == "a folder"


def test_resolve_config_finds_file_in_subfolder_of_context(folders: SearchFolders) -> None:
    file = folders.put("share1/contexts/lab/left/arm.yaml")
    assert resolve(folders, "lab", "left/arm.yaml").path == file
    assert resolve(folders, "lab/left", "", "arm").path == file


@pytest.mark.parametrize(
    "context", ["../x", "/etc", "a/../b", "a//b", ".", "..", ".hidden", "a/", "a\0b", "a b", "é"]
)
def test_resolve_config_rejects_context_outside_search_path(
    folders: SearchFolders, context: str
) -> None:
    folders.put("share1/x/arm.yaml")
    with pytest.raises(ConfigError, match="is not a valid context: use letters, digits"):
        resolve(folders, context, "", "arm")


@pytest.mark.parametrize("file", ["../arm.yaml", "/etc/passwd", "a/../../x.yaml", ".", "a\0b"])
def test_resolve_config_rejects_file_outside_search_path(folders: SearchFolders, file: str) -> None:
    folders.put("arm.yaml")
    with pytest.raises(
        ConfigError,
        match=r"cannot be searched for: it leaves the search paths; `--config` accepts any path",
    ):
        resolve(folders, "", file)


def test_resolve_config_rejects_robot_name_outside_search_path(folders: SearchFolders) -> None:
    folders.environment["ROBOCOMP_ROBOT_NAME"] = "../../x"
    with pytest.raises(ConfigError, match=r"ROBOCOMP_ROBOT_NAME:1:1\n"):
        resolve(folders, "", "arm.yaml")


def test_resolve_config_suggests_similar_name(folders: SearchFolders) -> None:
    folders.put("share1/contexts/laboratory/armature.yaml")
    with pytest.raises(ConfigError, match=r"did you mean `armature\.yaml`"):
        resolve(folders, "laboratory", "armatur.yaml")
    assert resolve(folders, "laboratry").warnings == (
        "no folder has the context `laboratry`; did you mean `laboratory`?",
    )


def test_search_environment_reads_xdg_variables(
    folders: SearchFolders, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without variables of RoboComp; `platformdirs` reads the environment of the process."""
    for name in ("CONFIG_HOME", "DATA_HOME", "CONFIG_DIRS", "DATA_DIRS"):
        listed = ":".join(str(folders.top / f"{name}{i}") for i in ("", 2)[: 1 + ("S" in name[-1])])
        monkeypatch.setenv(f"XDG_{name}", listed)
    environment = SearchEnvironment.from_environ({}, folders.work)
    assert environment.config_home == folders.top / "CONFIG_HOME/robocomp"
    assert environment.data_home == folders.top / "DATA_HOME/robocomp"
    assert environment.config_dirs == tuple(
        folders.top / f"CONFIG_DIRS{i}/robocomp" for i in ("", 2)
    )
    assert environment.data_dirs == (
        *(folders.top / f"DATA_DIRS{i}/robocomp" for i in ("", 2)),
        Path(sys.prefix) / "share/robocomp",
    )
    assert environment.robot == "default"


def test_resolve_config_searches_path_drop_ins(folders: SearchFolders) -> None:
    folders.put("share1/path.d/b.yaml", f"path: [{folders.top}/two, three]\n")
    folders.put("user/config/path.d/more.conf", "")  # shadows that of `share2`
    folders.put("two/path.d/x.conf", str(folders.top / "never"))  # not searched again
    for folder in ("two", "share1/path.d/three", "dropped", "never"):
        folders.put(f"{folder}/contexts/lab/{Path(folder).name}.yaml")
    for name, there in {"two": True, "three": True, "dropped": False, "never": False}.items():
        assert bool(resolve(folders, "lab", "", name).path) is there, name


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.yaml", "pth: [x]\n", "a.yaml:1:1"),
        ("a.yaml", "path: x\n", "`path` is not a list `path`"),
        ("a.yaml", "path: [{a: 1}]\n", "not a folder"),
        ("a.yaml", "path: [\n", "a.yaml:2:1"),
        ("a.conf", "\0", "this is a binary file"),
        ("a.conf", "ok\n  ~nobody-at-all/x\n", "a.conf:2:3"),
    ],
)
def test_resolve_config_warns_of_bad_drop_in_and_continues(
    folders: SearchFolders, name: str, text: str, message: str
) -> None:
    folders.put(f"user/config/path.d/{name}", text)
    folders.put("dropped/contexts/lab/arm.yaml")
    found = resolve(folders, "lab", "", "arm")
    assert found.path
    assert len(found.warnings) == 1
    assert message in found.warnings[0]


@pytest.mark.parametrize(
    ("there", "file", "save_path"),
    [
        ("work/etc/arm.yaml", "arm.yaml", "work/etc/arm.yaml"),
        ("user/data/contexts/lab/arm.yaml", "", "user/data/contexts/lab/arm.yaml"),
        ("user/config/arm.yaml", "arm.yaml", "user/config/arm.yaml"),
        ("share1/contexts/lab/arm.yaml", "", "user/data/contexts/lab/arm.yaml"),
        ("share1/robots/twin/arm.yaml", "arm.yaml", "user/data/robots/twin/arm.yaml"),
        ("share1/arm.yaml", "arm.yaml", "user/data/contexts/lab/arm.yaml"),
        ("share1/contexts/lab/a/b.yaml", "a/b.yaml", "user/data/contexts/lab/a/b.yaml"),
        ("work/other.yaml", "", "user/data/contexts/lab/arm.yaml"),
    ],
)
def test_resolve_config_selects_folder_for_saved_values(
    folders: SearchFolders, there: str, file: str, save_path: str
) -> None:
    folders.put(there)
    assert resolve(folders, "lab", file, "left-arm", "arm").save_beside == folders.top / save_path
