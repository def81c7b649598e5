"""Which configuration wins, where it is looked for, and what is said when there is none."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from robocomp_dsl.runtime.config import (
    ConfigRequest,
    ConfigResult,
    SearchEnvironment,
    resolve_config,
)
from robocomp_dsl.runtime.parameters import ConfigError
from tests.runtime.config_machine import Machine

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
"""The whole search for a file of `--from`, with the robot `twin` and the context `lab`."""


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    computer = Machine(tmp_path)
    computer.environment["ROBOCOMP_ROBOT_NAME"] = "twin"
    computer.put("share2/path.d/more.conf", "# where another package is\n\n../../dropped  # here\n")
    return computer


def chosen(machine: Machine, context: str = "", file: str = "", *names: str) -> ConfigResult:
    return resolve_config(
        ConfigRequest(context, file, names),
        SearchEnvironment.from_environ(machine.environment, machine.work),
    )


def test_every_place_in_its_order(machine: Machine) -> None:
    """All have the file; the winner is taken away, again and again."""
    files = [machine.put(place.format("arm.yaml")) for place in ORDER]
    for file in files:
        found = chosen(machine, "lab", "arm.yaml")
        assert found.path is not None
        assert found.path.resolve() == file
        file.unlink()
    with pytest.raises(ConfigError) as caught:
        chosen(machine, "lab", "arm.yaml")
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
        # The name that fits best counts more than whose file it is.
        (
            ["share1/contexts/lab/left-arm.yaml", "user/data/contexts/lab/arm.yaml"],
            "share1/contexts/lab/left-arm.yaml",
        ),
        (["user/data/contexts/lab/config.yaml"], "user/data/contexts/lab/config.yaml"),
        (["share1/contexts/lab/arm.toml"], "share1/contexts/lab/arm.toml"),
        # Only the context is asked; what else lies around is not meant.
        (["work/arm.yaml", "user/data/arm.yaml", "share1/contexts/other/arm.yaml"], None),
        ([], None),
    ],
)
def test_a_context_without_a_file(machine: Machine, there: list[str], winner: str | None) -> None:
    for path in there:
        machine.put(path)
    found = chosen(machine, "lab", "", "left-arm", "arm")
    assert found.path == (machine.top / winner if winner else None)


def test_a_folder_of_the_name_is_no_file(machine: Machine) -> None:
    (machine.work / "arm.yaml").mkdir()
    below = machine.put("share1/arm.yaml")
    found = chosen(machine, "", "arm.yaml")
    assert found.path == below
    assert found.candidates[0].skip_reason == "a folder"


def test_files_in_folders_of_a_context(machine: Machine) -> None:
    file = machine.put("share1/contexts/lab/left/arm.yaml")
    assert chosen(machine, "lab", "left/arm.yaml").path == file
    assert chosen(machine, "lab/left", "", "arm").path == file


@pytest.mark.parametrize(
    "context", ["../x", "/etc", "a/../b", "a//b", ".", "..", ".hidden", "a/", "a\0b", "a b", "é"]
)
def test_contexts_that_lead_elsewhere(machine: Machine, context: str) -> None:
    machine.put("share1/x/arm.yaml")
    with pytest.raises(ConfigError, match="is not a valid context: use letters, digits"):
        chosen(machine, context, "", "arm")


@pytest.mark.parametrize("file", ["../arm.yaml", "/etc/passwd", "a/../../x.yaml", ".", "a\0b"])
def test_files_that_lead_elsewhere(machine: Machine, file: str) -> None:
    machine.put("arm.yaml")
    with pytest.raises(
        ConfigError,
        match=r"cannot be searched for: it leaves the search paths; `--config` accepts any path",
    ):
        chosen(machine, "", file)


def test_a_robot_that_leads_elsewhere(machine: Machine) -> None:
    machine.environment["ROBOCOMP_ROBOT_NAME"] = "../../x"
    with pytest.raises(ConfigError, match=r"ROBOCOMP_ROBOT_NAME:1:1\n"):
        chosen(machine, "", "arm.yaml")


def test_near_names_are_told(machine: Machine) -> None:
    machine.put("share1/contexts/laboratory/armature.yaml")
    with pytest.raises(ConfigError, match=r"did you mean `armature\.yaml`"):
        chosen(machine, "laboratory", "armatur.yaml")
    assert chosen(machine, "laboratry").warnings == (
        "no folder has the context `laboratry`; did you mean `laboratory`?",
    )


def test_xdg_folders(machine: Machine, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without variables of ours; `platformdirs` reads the process's own environment."""
    for name in ("CONFIG_HOME", "DATA_HOME", "CONFIG_DIRS", "DATA_DIRS"):
        listed = ":".join(str(machine.top / f"{name}{i}") for i in ("", 2)[: 1 + ("S" in name[-1])])
        monkeypatch.setenv(f"XDG_{name}", listed)
    around = SearchEnvironment.from_environ({}, machine.work)
    assert around.config_home == machine.top / "CONFIG_HOME/robocomp"
    assert around.data_home == machine.top / "DATA_HOME/robocomp"
    assert around.config_dirs == tuple(machine.top / f"CONFIG_DIRS{i}/robocomp" for i in ("", 2))
    assert around.data_dirs == (
        *(machine.top / f"DATA_DIRS{i}/robocomp" for i in ("", 2)),
        Path(sys.prefix) / "share/robocomp",
    )
    assert around.robot == "default"


def test_drop_ins(machine: Machine) -> None:
    machine.put("share1/path.d/b.yaml", f"path: [{machine.top}/two, three]\n")
    machine.put("user/config/path.d/more.conf", "")  # shadows that of `share2`
    machine.put("two/path.d/x.conf", str(machine.top / "never"))  # not searched again
    for folder in ("two", "share1/path.d/three", "dropped", "never"):
        machine.put(f"{folder}/contexts/lab/{Path(folder).name}.yaml")
    for name, there in {"two": True, "three": True, "dropped": False, "never": False}.items():
        assert bool(chosen(machine, "lab", "", name).path) is there, name


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
def test_wrong_drop_ins_are_told_and_the_rest_counts(
    machine: Machine, name: str, text: str, message: str
) -> None:
    machine.put(f"user/config/path.d/{name}", text)
    machine.put("dropped/contexts/lab/arm.yaml")
    found = chosen(machine, "lab", "", "arm")
    assert found.path
    assert len(found.warnings) == 1
    assert message in found.warnings[0]


@pytest.mark.parametrize(
    ("there", "file", "keeps"),
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
def test_where_live_values_are_kept(machine: Machine, there: str, file: str, keeps: str) -> None:
    machine.put(there)
    assert chosen(machine, "lab", file, "left-arm", "arm").save_beside == machine.top / keeps
