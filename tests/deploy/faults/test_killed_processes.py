"""SIGKILL to each component under load, and to the fork server."""

from __future__ import annotations

import os
import signal
from pathlib import Path

from tests.campaign.components import count_calls
from tests.campaign.faults import UNDER_LOAD, kill_by_turns
from tests.campaign.running_deployment import RunningDeployment
from tests.support.waiting import wait_until


def words(pid: int, file: str) -> list[str]:
    return Path(f"/proc/{pid}/{file}").read_text().split("\0")[:-1]


def parent(pid: int) -> int:
    return int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])


def acknowledged(folder: Path) -> int:
    return count_calls(folder)["acknowledged"] if (folder / "journals/executed").exists() else 0


def test_killed_components_are_restarted_and_no_acknowledged_call_is_lost(folder: Path) -> None:
    with RunningDeployment(folder / "campaign.ddsl") as app:
        app.wait_ready()
        figures = kill_by_turns(app, len(UNDER_LOAD))
        before = acknowledged(folder)
        wait_until(lambda: acknowledged(folder) > before, "calls go on")
    assert figures["not restarted"] == 0
    calls = count_calls(folder)
    assert (calls["lost"], calls["doubled"]) == (0, 0)


def test_forked_component_is_like_an_executed_one(folder: Path) -> None:
    with RunningDeployment(folder / "campaign.ddsl") as app:
        app.wait_ready()
        pids = [app.pid(name) for name in ("ledger", "caller")]
        server = parent(pids[0])
        assert "server.py" in " ".join(words(server, "cmdline"))
        assert parent(server) == app.process.pid
        for pid, name in zip(pids, ("ledger", "caller"), strict=True):
            command = words(pid, "cmdline")
            assert command[1:4] == ["main.py", "--name", name]
            variables = words(pid, "environ")
            assert any(each.startswith("ROBOCOMP_DEPLOYMENT=campaign-") for each in variables)
            assert os.getsid(pid) == os.getpgid(pid) == pid
            assert Path(f"/proc/{pid}/cwd").resolve() == (folder / name).resolve()
            assert Path(f"/proc/{pid}/fd/0").readlink() == Path("/dev/null")
        assert app.stop() == 0


def test_killed_fork_server_stops_no_component(folder: Path) -> None:
    with RunningDeployment(folder / "campaign.ddsl") as app:
        app.wait_ready()
        rows = app.rows()
        server = parent(rows["ledger"]["pid"])
        os.kill(server, signal.SIGKILL)
        wait_until(lambda: "the fork server died" in app.log.read_text(), "it is reported")
        assert app.rows()["ledger"]["pid"] == rows["ledger"]["pid"]
        os.kill(rows["echo"]["pid"], signal.SIGKILL)
        assert app.restarted("echo", rows["echo"]["pid"]) is not None
        assert parent(app.pid("echo")) == app.process.pid
        assert app.stop() == 0, app.log.read_text()
