"""A generated bridge as a program: `python main.py`, and under `rcdeploy`."""

from __future__ import annotations

import math
import signal
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tests.bridge.bridge_run import NUMBERS, Peer, generate
from tests.bridge.test_generated_bridge import SLICE
from tests.cli.rcgen_run import Rcgen
from tests.deploy.rcdeploy_process import (
    RunningProcess,
    rcdeploy,
    runtime_folder,
    start_rcdeploy,
)
from tests.support.waiting import wait_until

Peers = Callable[..., Peer]
pytestmark = pytest.mark.usefixtures("name_server")


@pytest.mark.parametrize("launcher", ["python main.py", "rcdeploy up"])
def test_bridge_program_passes_data_with_peers_of_its_file(
    rcgen: Rcgen,
    tmp_path: Path,
    peer: Peers,
    monkeypatch: pytest.MonkeyPatch,
    launcher: str,
) -> None:
    folder = generate(rcgen, tmp_path, SLICE)
    push = peer("yarp", source="/rover/left:o").publisher(NUMBERS, "source")
    seen = peer("yarp", viewer="/viewer:i").subscribe(NUMBERS, "viewer")
    monkeypatch.chdir(folder)
    with runtime_folder(monkeypatch):
        is_deployed = launcher == "rcdeploy up"
        started = (
            start_rcdeploy("up", "rover.ddsl")
            if is_deployed
            else RunningProcess(sys.executable, "main.py", where=folder)
        )
        with started as running:
            wait_until(lambda: (push(np.array([180.0])), seen)[1])
            assert seen[0].tolist() == pytest.approx([math.pi])
            if is_deployed:
                shown = rcdeploy("status", "rover.ddsl").stdout
                assert all(name in shown for name in ("rover_left_o", "viewer_i", "yarp"))
                shown = rcdeploy("connections", "rover.ddsl").stdout
                assert all(name in shown for name in ("rover_left_o", "viewer_i", "left"))
                shown = rcdeploy("stats", "rover", "--deployment", "rover.ddsl").stdout
                assert "angles.send" in shown
            running.process.send_signal(signal.SIGINT)
            assert running.end() == 0
            assert running.has("output `angles`:")
