"""Programs that know nothing of this project: readiness, sd_notify, limits of their resources."""

from __future__ import annotations

import asyncio
import os
import signal
import socket
from collections.abc import Callable
from pathlib import Path

import pytest

from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.supervisor import process_watch
from robocomp_dsl.deploy.supervisor.notify import NotifySocket, parse_message
from robocomp_dsl.deploy.supervisor.run_options import Options, Outcome
from robocomp_dsl.host_tools.resource_limits import LimitTracker, TreeUsage
from robocomp_dsl.model.deployment import Readiness, ResourceLimits, Restart
from tests.deploy.scripted_processes import scripted_process
from tests.deploy.supervisor_run import SupervisorRun, stop

NOTIFY = """
import socket, time
def notify(text):
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as s:
        s.connect(os.environ["NOTIFY_SOCKET"].replace("@", "\\0", 1))
        s.send(text.encode())
"""
NEVER = Restart("never")


class ForeignRun(SupervisorRun):
    """A run that listens for sd_notify messages."""

    def run(self) -> Outcome:
        folder = self.plan.path.parent
        self.on("rcdeploy: listening", lambda run: run.engine.receive_notifications(folder))
        original = self.monitor.start

        def start(seen: Callable[[str, int, str], None]) -> None:
            original(seen)
            self.engine.log("listening")

        self.monitor.start = start  # type: ignore[method-assign]
        return super().run()


@pytest.mark.parametrize(
    ("readiness", "body"),
    [
        (Readiness(pattern="listening on [0-9]+"), 'print("x"); print("now listening on 8080")'),
        (Readiness(delay_s=0.05), ""),
    ],
)
def test_readiness_of_foreign_programs(tmp_path: Path, readiness: Readiness, body: str) -> None:
    foreign = scripted_process(tmp_path, "a", f"{body}\nwait()", readiness=readiness)
    run = SupervisorRun(
        tmp_path,
        foreign,
        scripted_process(tmp_path, "b", 'report("compute"); wait()', after=("a",)),
    )
    run.on("all 2 components are ready", stop)
    assert run.run() == Outcome(0, "test")
    assert run.at("a is ready") < run.at("b is ready")


def test_readiness_by_a_port_that_answers(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    go = tmp_path / "go"
    body = f"""
import socket
report("compute")
while not os.path.exists({str(go)!r}) and not stopped.is_set(): pass
server = socket.create_server(("127.0.0.1", {port})); print("serving"); wait()
"""
    run = SupervisorRun(
        tmp_path, scripted_process(tmp_path, "a", body, readiness=Readiness(port=port))
    )
    # Its lifecycle says that it is ready, but its own condition decides.
    run.changed = lambda: go.touch() if run.row("a").life == "compute" else None
    assert run.on("a is ready", stop).run() == Outcome(0, "test")
    assert run.at("a: serving") < run.at("a is ready")


def test_readiness_that_never_comes_is_a_failure(tmp_path: Path) -> None:
    foreign = scripted_process(
        tmp_path, "a", 'print("other"); wait()', readiness=Readiness(pattern="listening"),
        start_timeout_s=0.3, restart=NEVER,
    )  # fmt: skip
    assert SupervisorRun(tmp_path, foreign).run() == Outcome(1, "failed: a")


def test_sd_notify_ready_and_status(tmp_path: Path) -> None:
    body = NOTIFY + 'notify("STATUS=loading 3 of 5"); notify("READY=1\\nSTATUS=serves"); wait()'
    run = ForeignRun(tmp_path, scripted_process(tmp_path, "a", body))
    notes: list[str] = []

    def changed() -> None:
        row = run.row("a")
        notes.append(f"{row.state} {row.note}".rstrip())
        if notes[-1] == "ready serves":
            run.engine.stop("test")

    run.changed = changed
    assert run.run() == Outcome(0, "test")
    assert notes.index("starting loading 3 of 5") < notes.index("ready serves")


def test_sd_notify_of_another_process_is_ignored(tmp_path: Path) -> None:
    liar = scripted_process(tmp_path, "b", NOTIFY + 'notify("READY=1"); report("compute"); wait()')
    silent = scripted_process(tmp_path, "a", "wait()", start_timeout_s=0.5, restart=NEVER)
    run = ForeignRun(tmp_path, silent, liar)
    assert run.run() == Outcome(1, "failed: a")
    assert run.at("b is ready")


def test_sd_notify_watchdog_restarts_a_program_that_hangs(tmp_path: Path) -> None:
    hung = tmp_path / "hung"
    body = f"""{NOTIFY}
notify("READY=1")
while not stopped.is_set():
    if os.environ["WATCHDOG_USEC"] != "200000": break
    notify("WATCHDOG=1"); time.sleep(0.02)
    if not os.path.exists({str(hung)!r}):
        open({str(hung)!r}, "w").close(); print("hangs"); wait(); print("finalized")
"""
    process = scripted_process(tmp_path, "a", body, env=(("WATCHDOG_USEC", "200000"),))
    run = ForeignRun(tmp_path, process).on("a hangs: no WATCHDOG=1 within 0.2 s", lambda _: None)
    run.on("restarting in 0.1 s", lambda r: r.on("a is ready", stop))
    assert run.run() == Outcome(0, "test")
    assert run.row("a").restarts == 1
    assert run.texts("a") == ["hangs", "finalized"]
    restart = next(t for t in run.texts("rcdeploy") if "restarting" in t)
    assert restart == "a: hangs: no WATCHDOG=1 within 0.2 s, restarting in 0.1 s"


def test_notify_socket_takes_any_bytes(tmp_path: Path) -> None:
    messages: list[tuple[int, dict[str, str]]] = []

    async def listen(folder: Path) -> None:
        received = NotifySocket(folder, lambda pid, m: messages.append((pid, dict(m))))
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as sender:
            sender.connect(received.address.replace("@", "\0", 1))
            read_end, write_end = os.pipe()
            for data in (b"", b"\xff=\xfe\n\n=", b"A" * 9000, b"READY=1\nSTATUS=a=b"):
                sender.send(data)
            socket.send_fds(sender, [b"BARRIER=1"], [write_end])
            os.close(write_end)
            while len(messages) < 5:
                await asyncio.sleep(0.001)
        # The received end of the pipe is closed, which is the answer to a barrier.
        assert os.read(read_end, 1) == b""
        os.close(read_end)
        received.close()

    deep = tmp_path / ("d" * 120)
    deep.mkdir()
    for folder in (tmp_path, deep):
        messages.clear()
        asyncio.run(listen(folder))
        assert messages[3] == (os.getpid(), {"READY": "1", "STATUS": "a=b"})
        assert {pid for pid, _ in messages} == {os.getpid()}
    assert not (tmp_path / "notify").exists()
    assert parse_message(b"X") == {}


def test_limits_of_a_sample() -> None:
    limits = LimitTracker(ResourceLimits(memory_bytes=100_000_000, cpu=0.8), tolerance_s=5.0)
    assert limits.add(0.0, 90_000_000, 0.7) == []
    (warning,) = limits.add(1.0, 120_000_000, 0.7)
    assert (warning.text, warning.is_lasting) == (
        "uses 120 MB of memory, its limit is 100 MB", False,
    )  # fmt: skip
    (warning,) = limits.add(2.0, 130_000_000, 1.5)
    assert warning.text == "uses 150% of a core, its limit is 80%"
    assert limits.add(3.0, 90_000_000, 1.5) == []
    assert [e.is_lasting for e in limits.add(4.0, 120_000_000, 1.5)] == [False]
    (excess,) = limits.add(7.5, 120_000_000, 1.5)
    assert excess.is_lasting


def test_limits_count_the_children_of_a_process() -> None:
    usage = TreeUsage(os.getpid())
    usage.sample()
    alone = usage.memory
    pid = os.fork()
    if not pid:
        signal.pause()
        os._exit(0)
    try:
        usage.sample()
        assert usage.memory > alone * 1.1
    finally:
        os.kill(pid, signal.SIGKILL)
        os.waitpid(pid, 0)


def test_limits_warn_and_then_restart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process_watch, "SAMPLE_S", 0.02)
    monkeypatch.setattr(LimitTracker.__init__, "__defaults__", (0.1,))
    grown = tmp_path / "grown"
    body = f"""
report("compute")
if not os.path.exists({str(grown)!r}):
    open({str(grown)!r}, "w").close(); block = b"x" * 150_000_000
wait(); print("finalized")
"""
    limits = ResourceLimits(memory_bytes=100_000_000)
    process: Process = scripted_process(tmp_path, "a", body, limits=limits)
    run = SupervisorRun(tmp_path, process, options=Options(grace_s=5.0))
    run.on("restarting in 0.1 s", lambda r: r.on("a is ready", stop))
    assert run.run() == Outcome(0, "test")
    texts = [t for t in run.texts("rcdeploy") if "of memory, its limit is 100 MB" in t]
    assert len(texts) == 3  # the warning, the error, and why it restarts
    assert run.texts("a") == ["finalized", "finalized"]
    levels = [r.level for r in run.records if "of memory" in r.text]
    assert levels == ["WARNING", "ERROR", "WARNING"]
