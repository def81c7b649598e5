"""`run_when`: starts a program when ports of YARP exist."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from robocomp_dsl.runtime.middleware.yarp import run_when
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient
from robocomp_dsl.runtime.middleware.yarp.name_server import NameServer
from tests.middleware.yarp.conftest import LOOPBACK

SHOW = "import os; print(os.getcwd(), 'runs')"


@pytest.fixture
def configured(
    name_server: NameServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> NameServer:
    """The name server, which `yarp.conf` names."""
    (tmp_path / "yarp.conf").write_text(f"{LOOPBACK} {name_server.number} yarp\n")
    monkeypatch.setenv("YARP_CONFIG_HOME", str(tmp_path))
    monkeypatch.delenv("YARP_NAMESPACE", raising=False)
    return name_server


def test_run_when_becomes_the_command_when_the_ports_exist(
    configured: NameServer, names: NameClient, tmp_path: Path
) -> None:
    command = [
        sys.executable,
        "-m",
        run_when.__name__,
        "--timeout",
        "60",
        "--folder",
        str(tmp_path),
    ]
    waiting = subprocess.Popen(
        [*command, "/a", "/b", "--", sys.executable, "-c", SHOW],
        stdout=subprocess.PIPE,
        text=True,
    )
    names.register("/a", LOOPBACK, 10005)
    names.register("/b", LOOPBACK, 10006)
    assert waiting.communicate(timeout=60)[0] == f"{tmp_path} runs\n"
    assert waiting.returncode == 0


def test_run_when_tells_which_ports_are_missing(
    configured: NameServer, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_when.main(["--timeout", "0", "/a", "/root", "/b", "--", "true"]) == 1
    message = "error: there is no port /a, /b after 0 s; not started: true\n"
    assert capsys.readouterr().err == message


def test_run_when_tells_why_a_command_does_not_start(
    configured: NameServer, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_when.main(["/root", "--", "no-such-program"]) == 127
    assert "`no-such-program` cannot be started" in capsys.readouterr().err
    assert run_when.main(["--folder", "/no/folder", "/root", "--", "true"]) == 127
    assert "`true` cannot be started" in capsys.readouterr().err
    configured.close()
    assert run_when.main(["--timeout", "0", "/root", "--", "true"]) == 1
    assert "the name server cannot be reached" in capsys.readouterr().err


@pytest.mark.parametrize("words", [["/a"], ["/a", "--"], ["--", "true"]])
def test_run_when_needs_ports_and_a_command(words: list[str]) -> None:
    with pytest.raises(SystemExit) as leaving:
        run_when.main(words)
    assert leaving.value.code == 2
