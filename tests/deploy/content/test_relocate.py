"""Command lines, environment and folders with the paths of a host."""

from __future__ import annotations

import json
from pathlib import Path

from robocomp_dsl.deploy.content.relocate import relocate
from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.process import Process

TREE = ContentTree(
    Path("/w s"),
    "arm",
    (),
    named=(("/w s/mon/watch.py", "mon/watch.py"), ("/w s/arm", "arm"), ("/w s/eye", "eye")),
)
THERE = "/@home/.local/trees/h"


def moved(process: Process, tree: ContentTree = TREE) -> Process:
    return relocate(process, tree, tree_folder=THERE, python="/env/python", interpreter="/py")


def test_relocate_rewrites_paths_in_json_and_environment() -> None:
    monitors = json.dumps([{"file": "/w s/mon/watch.py", "at": "x"}])
    process = Process(
        "arm",
        "arm",
        ("/py", "main.py", "--monitors", monitors, "--set", "file=/w s/armor", "--set", "a=/py"),
        Path("/w s/arm"),
        env=(("DEVICES", json.dumps({"model": "/w s/arm/arm.xml"})), ("HOME", "/home/me")),
    )
    there = moved(process)
    assert there.argv[0] == "/env/python"
    assert json.loads(there.argv[3])[0]["file"] == f"{THERE}/mon/watch.py"
    assert there.argv[4:] == ("--set", "file=/w s/armor", "--set", "a=/py")
    assert json.loads(dict(there.env)["DEVICES"])["model"] == f"{THERE}/arm/arm.xml"
    assert dict(there.env)["HOME"] == "/home/me"
    assert there.cwd == Path(THERE, "arm")


def test_relocate_keeps_other_programs() -> None:
    process = Process("arm", "arm", ("./arm", "/py"), Path("/w s/arm"))
    assert moved(process).argv == ("./arm", "/py")


def test_relocate_moves_members_of_a_group() -> None:
    arm = Process(
        "arm", "arm", ("/py", "main.py", "--name", "arm"), Path("/w s/arm"), context="lab"
    )
    eye = Process("eye", "eye", ("/py", "main.py", "--name", "eye"), Path("/w s/eye"))
    options = ("--component", "/w s/arm", "--name", "arm", "--context", "lab", "--config-name", "a")
    argv = ("/py", "-m", "group", *options, "--component", "/w s/eye", "--context", "lab")
    group = Process("g", "group", argv, Path("/w s"), members=(arm, eye))
    tree = ContentTree(TREE.origin, ".", (), named=TREE.named, configs=(("arm", "etc/lab.yaml"),))
    there = moved(group, tree)
    assert there.argv == (
        "/env/python", "-m", "group",
        "--component", f"{THERE}/arm", "--name", "arm", "--config", f"{THERE}/etc/lab.yaml",
        "--component", f"{THERE}/eye", "--context", "lab",
    )  # fmt: skip
    assert [member.cwd for member in there.members] == [Path(THERE, "arm"), Path(THERE, "eye")]
    assert there.members[0].config == Path(THERE, "etc/lab.yaml")
    assert (there.members[0].context, there.cwd) == ("", Path(THERE))
