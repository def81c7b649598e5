"""The option `--monitors` of a component: errors end it before it opens a port."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from robocomp_dsl.runtime import main
from tests.docs.blocks import ROOT
from tests.monitors.components import HEADER, Listener

ENTRY = {"port": "News", "at": "receiver", "peer": "speaker.News"}


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("[", "--monitors is no JSON"),
        (json.dumps([ENTRY | {"port": "Nows"}]), "listener has no port `Nows`; its ports: News"),
        (json.dumps([ENTRY | {"when": "e_a or"}]), "an event is missing after `or`"),
    ],
)
def test_monitors_option_that_is_invalid_is_an_error_of_the_command_line(
    capsys: pytest.CaptureFixture[str], value: str, message: str
) -> None:
    with pytest.raises(SystemExit) as caught:
        main(Listener, ["--monitors", value])
    assert caught.value.code == 2
    assert message in capsys.readouterr().err


def test_monitors_option_with_a_class_that_does_not_fit_ends_the_component(tmp_path: Path) -> None:
    file = tmp_path / "limits.py"
    file.write_text(
        HEADER + "class Limit(Monitor):\n"
        "    def accept_announced(self, who: int, n: str) -> bool:\n"
        "        return True\n"
    )
    monitor = {"file": str(file), "class": "Limit"}
    value = json.dumps([ENTRY | {"monitors": [monitor]}])
    ended = subprocess.run(
        [sys.executable, "-m", "tests.monitors.listener", "--monitors", value],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert ended.returncode == 1
    assert f"{file}:3:32: `who` is of type str, not int" in ended.stderr
    assert f"{file}:3:42: `n` is of type int, not str" in ended.stderr
    assert "Traceback" not in ended.stderr
