"""The folder of the reflex component: nothing in it knows a robot, and its words are one."""

from __future__ import annotations

import re

from puppet import REFLEX, words

ROBOT_NAMES = re.compile(r"nao|icub|robocup", re.IGNORECASE)


def test_no_robot_is_named_anywhere() -> None:
    files = [
        path
        for path in sorted(REFLEX.folder.rglob("*"))
        if path.is_file() and not re.search(r"__pycache__|_cache/", str(path))
    ]
    assert {"README.md", "specificworker.py", "config.yaml", "reflex.smdsl"} <= {
        path.name for path in files
    }
    for path in files:
        assert not ROBOT_NAMES.search(path.read_text(encoding="utf-8")), path.name
        assert not ROBOT_NAMES.search(path.name)


def test_the_states_of_the_machine_are_those_that_the_interface_tells() -> None:
    machine = REFLEX.worker.SPEC.machine
    assert {one.name for one in machine.states} == {one.name for one in words.ReflexState}
