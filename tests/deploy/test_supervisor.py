"""The supervisor with real processes: order, readiness, restarts, stop, and nothing left behind."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from robocomp_dsl.deploy.logs import LogRecord
from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.status import ProcessStatus
from robocomp_dsl.deploy.supervisor.reaper import find_processes
from robocomp_dsl.deploy.supervisor.supervisor import Options, Outcome, Supervisor
from robocomp_dsl.model.deployment import Restart
from tests.deploy.deploy_actors import STEADY, FifoWatch, actor, plan_of

NEVER = Restart("never")
FAR_TOO_LONG_S = 120.0


class Run:
    """One run of the supervisor in this process, steered by what it says."""

    def __init__(self, tmp_path: Path, *processes: Process, options: Options | None = None) -> None:
        self.plan = plan_of(tmp_path, *processes)
        self.watch = FifoWatch(tmp_path / "fifo")
        self.options = options or Options(grace_s=5.0)
        self.records: list[LogRecord] = []
        self.changed: Callable[[], None] = lambda: None
        self.reactions: list[tuple[str, Callable[[Run], object]]] = []

    def on(self, text: str, reaction: Callable[[Run], object]) -> Run:
        """Call `reaction` at the first record that contains `text`."""
        self.reactions.append((text, reaction))
        return self

    def emit(self, record: LogRecord) -> None:
        self.records.append(record)
        for reaction in [r for r in self.reactions if r[0] in f"{record.component}: {record.text}"]:
            self.reactions.remove(reaction)
            reaction[1](self)

    def run(self) -> Outcome:
        token = f"{self.plan.domain}.{os.getpid()}"

        async def supervised() -> Outcome:
            self.engine = Supervisor(
                self.plan, token, self.watch,
                emit=self.emit, changed=self.changed, options=self.options,
            )  # fmt: skip
            return await asyncio.wait_for(self.engine.run(), FAR_TOO_LONG_S)

        outcome = asyncio.run(supervised())
        assert find_processes(token) == []
        assert self.reactions == []
        return outcome

    def row(self, name: str) -> ProcessStatus:
        return next(row for row in self.engine.statuses() if row.name == name)

    def texts(self, component: str) -> list[str]:
        return [r.text for r in self.records if r.component == component]

    def at(self, text: str) -> int:
        """Position of the first record that contains `text`."""
        return next(i for i, r in enumerate(self.records) if text in f"{r.component}: {r.text}")


def stop(run: Run) -> None:
    run.engine.stop("test")


def test_each_starts_when_what_it_needs_is_ready_and_stops_before_it(tmp_path: Path) -> None:
    body = 'print("began"); ' + STEADY
    run = Run(
        tmp_path,
        actor(tmp_path, "base", body, stops_after=("nav", "log")),
        actor(tmp_path, "nav", body, after=("base",), stops_after=("log",)),
        actor(tmp_path, "log", body, after=("nav", "base")),
    ).on("all 3 components are ready", stop)
    assert run.run() == Outcome(0, "test")
    order = ["base: began", "base is ready", "nav: began", "nav is ready", "log: began",
             "log: finalized", "nav: finalized", "base: finalized"]  # fmt: skip
    places = [run.at(text) for text in order]
    assert places == sorted(places)
    assert {row.state for row in run.engine.statuses()} == {"exited"}


def test_those_without_order_start_together(tmp_path: Path) -> None:
    # Each becomes ready only when the other lives: one after the other would never end.
    other = 'open(NAME, "w").close()\nwhile not os.path.exists("ab".replace(NAME, "")): pass\n'
    run = Run(tmp_path, *(actor(tmp_path, n, other + STEADY) for n in "ab"))
    assert run.on("all 2 components are ready", stop).run().code == 0


def test_a_crash_is_restarted_and_the_new_life_must_be_ready_itself(tmp_path: Path) -> None:
    def kill(run: Run) -> None:
        os.kill(run.row("a").pid, signal.SIGKILL)

    body = 'print("life", os.getpid()); tell("initialize"); tell("compute"); wait()'
    run = Run(tmp_path, actor(tmp_path, "a", body), actor(tmp_path, "b", STEADY))
    run.on("all 2 components are ready", kill)
    run.on("a: killed by SIGKILL, restarting in 0.1 s", lambda r: r.on("a is ready", stop))
    assert run.run().code == 0
    first, second = run.texts("a")
    assert first != second
    assert run.row("a").restarts == 1
    assert run.row("b").restarts == 0


def test_restarts_wait_longer_and_longer_and_end(tmp_path: Path) -> None:
    crash = actor(tmp_path, "a", "print('dying'); sys.exit(3)", restart=Restart(max=3, window_s=60))
    run = Run(tmp_path, crash, actor(tmp_path, "b", STEADY))
    assert run.run() == Outcome(1, "failed: a")
    assert run.texts("a") == ["dying"] * 4
    lines = [t for t in run.texts("rcdeploy") if t.startswith(("a:", "a failed"))]
    assert lines == [
        "a: exit code 3, restarting in 0.1 s",
        "a: exit code 3, restarting in 0.2 s",
        "a: exit code 3, restarting in 0.4 s",
        "a failed permanently: exit code 3 (restart limit reached: 3 in 60 s)",
    ]
    assert "stopping: a failed" in run.texts("rcdeploy")
    assert run.row("b").state == "exited"


@pytest.mark.parametrize(
    ("policy", "body", "code", "lives", "state"),
    [
        ("never", "sys.exit(1)", 1, 1, "failed"),
        ("never", "tell('compute')", 0, 1, "exited"),
        ("on-failure", "tell('compute')", 0, 1, "exited"),
        ("always", "tell('compute')", 0, 3, "exited"),
        ("always", "sys.exit(1)", 1, 3, "failed"),
        ("on-failure", "os.kill(os.getpid(), signal.SIGSEGV)", 1, 3, "failed"),
    ],
)
def test_policies(
    tmp_path: Path, policy: str, body: str, code: int, lives: int, state: str
) -> None:
    script = f"print('life'); {body}"
    run = Run(tmp_path, actor(tmp_path, "a", script, restart=Restart(policy, 2, 60)))
    assert run.run().code == code
    assert run.texts("a") == ["life"] * lives
    assert run.row("a").state == state


def test_not_ready_in_time_ends_the_deployment(tmp_path: Path) -> None:
    slow = actor(tmp_path, "a", 'tell("initialize"); wait()', start_timeout_s=0.5)
    never = actor(tmp_path, "c", "print('never')", after=("a",))
    run = Run(tmp_path, slow, actor(tmp_path, "b", STEADY), never)
    assert run.run() == Outcome(1, "failed: a")
    assert run.row("a").note.startswith("not ready within 0.5 s")
    assert run.texts("c") == []
    assert run.row("c").note == "not started: a was not ready"


def test_keep_going(tmp_path: Path) -> None:
    bad = actor(tmp_path, "a", "sys.exit(2)", restart=NEVER)
    news = tmp_path / "news"
    body = f'tell("compute")\nwhile not os.path.exists({str(news)!r}): pass\nprint("alive"); wait()'
    run = Run(tmp_path, bad, actor(tmp_path, "b", body), options=Options(keep_going=True))
    run.on("a failed permanently", lambda _: news.touch()).on("b: alive", stop)
    assert run.run() == Outcome(1, "failed: a")


def test_one_that_did_its_work_lets_others_start(tmp_path: Path) -> None:
    once = actor(tmp_path, "a", "print('set up')")
    run = Run(tmp_path, once, actor(tmp_path, "b", STEADY, after=("a",)))
    assert run.on("b is ready", stop).run().code == 0


def test_sigterm_ignored_is_killed_after_its_grace(tmp_path: Path) -> None:
    deaf = actor(tmp_path, "a", 'signal.signal(15, signal.SIG_IGN); tell("compute"); wait()')
    run = Run(tmp_path, deaf, options=Options(grace_s=0.3)).on("a is ready", stop)
    assert run.run() == Outcome(1, "failed: a")
    assert "a did not exit within 0.3 s and was killed" in run.texts("rcdeploy")
    assert run.row("a").note == "killed by SIGKILL while stopping"


def test_asked_twice_everything_is_killed_at_once(tmp_path: Path) -> None:
    deaf = 'signal.signal(15, lambda *_: print("deaf")); tell("compute"); wait()'
    run = Run(tmp_path, actor(tmp_path, "a", deaf), options=Options(grace_s=FAR_TOO_LONG_S))
    run.on("a is ready", stop).on("a: deaf", stop)
    began = time.monotonic()
    assert run.run().code == 1
    assert time.monotonic() - began < FAR_TOO_LONG_S / 2


def test_all_together_have_a_deadline(tmp_path: Path) -> None:
    deaf = 'signal.signal(15, signal.SIG_IGN); tell("compute"); wait()'
    chain = [
        actor(tmp_path, f"a{i}", deaf, stops_after=(f"a{i + 1}",) if i < 4 else ())
        for i in range(5)
    ]
    run = Run(tmp_path, *chain, options=Options(grace_s=10, stop_timeout_s=0.5))
    assert run.on("all 5 components are ready", stop).run().code == 1


def test_stop_while_starting_and_while_waiting_to_restart(tmp_path: Path) -> None:
    starting = actor(tmp_path, "a", 'tell("initialize"); print("on my way"); wait()')
    run = Run(tmp_path, starting, actor(tmp_path, "b", STEADY, after=("a",)))
    run.on("a: on my way", stop)
    assert run.run().code == 0
    assert run.row("b").note == "not started: a was not ready"


def test_stop_while_waiting_to_restart(tmp_path: Path) -> None:
    run = Run(tmp_path, actor(tmp_path, "a", "sys.exit(1)", restart=Restart(max=90)))
    run.on("restarting in 0.4 s", stop)
    assert run.run().code == 0


def test_what_a_component_started_ends_with_it(tmp_path: Path) -> None:
    # One in its group, one that left the group as a daemon does.
    body = """
import subprocess
inside = subprocess.Popen([sys.executable, "-S", "-c", "import time; time.sleep(600)"])
escaped = subprocess.Popen([sys.executable, "-S", "-c", "import time; time.sleep(600)"],
                           start_new_session=True)
print("started"); tell("compute"); wait()
"""
    run = Run(tmp_path, actor(tmp_path, "a", body)).on("a is ready", stop)
    assert run.run().code == 0  # Run.run asserts that none is left


def test_a_program_that_cannot_be_started(tmp_path: Path) -> None:
    (tmp_path / "plain").write_text("no program")
    process = Process("a", "a", ("./plain",), tmp_path, restart=Restart(max=1))
    run = Run(tmp_path, process)
    assert run.run() == Outcome(1, "failed: a")
    assert run.row("a").note == "cannot be started: Permission denied"


def test_output_is_merged_and_whole(tmp_path: Path) -> None:
    log = json.dumps({"time": time.time(), "level": "WARNING", "message": "careful"})
    body = f"""
print('plain')
print({log!r})
print("to stderr", file=sys.stderr)
os.write(1, b"not utf-8 \\xff\\n" + b"x" * 200000 + b"\\n")
tell("compute"); wait()
sys.stdout.write("no line end")
"""
    run = Run(tmp_path, actor(tmp_path, "a", body)).on("a is ready", stop)
    assert run.run().code == 0
    by_stream = {s: [r for r in run.records if r.component == "a" and r.stream == s]
                 for s in ("stdout", "stderr", "log")}  # fmt: skip
    assert [r.text for r in by_stream["stderr"]] == ["to stderr"]
    assert [(r.level, r.text) for r in by_stream["log"]] == [("WARNING", "careful")]
    plain = [r.text for r in by_stream["stdout"]]
    assert plain[:2] == ["plain", "not utf-8 \N{REPLACEMENT CHARACTER}"]
    assert "".join(plain[2:-1]) == "x" * 200000
    assert plain[-1] == "no line end"


def test_a_flood_of_output_does_not_stop_the_supervisor(tmp_path: Path) -> None:
    flood = 'tell("compute")\nwhile not over.is_set(): print("flood " * 20)'
    run = Run(tmp_path, actor(tmp_path, "a", flood), actor(tmp_path, "b", STEADY))
    assert run.on("all 2 components are ready", stop).run().code == 0


def test_duration_counts_from_when_all_are_ready(tmp_path: Path) -> None:
    run = Run(tmp_path, actor(tmp_path, "a", STEADY), options=Options(duration_s=0.2))
    assert run.run() == Outcome(0, "duration of 0.2 s is over")


def test_the_status_follows_what_is_seen(tmp_path: Path) -> None:
    body = """
for state in ("initialize", "compute", "emergency", "gone", "compute"):
    tell(state)
wait()
"""
    run = Run(tmp_path, actor(tmp_path, "a", body))
    seen: list[tuple[str, str]] = []

    def changed() -> None:
        row = run.row("a")
        seen.append((row.state, row.life))
        if seen[-2:] == [("unknown", ""), ("ready", "compute")]:
            run.engine.stop("test")

    run.changed = changed
    assert run.run().code == 0
    steps = [step for step, before in zip(seen, [None, *seen], strict=False) if step != before]
    assert steps[:6] == [
        ("starting", ""), ("starting", "initialize"), ("ready", "compute"), ("ready", "emergency"),
        ("unknown", ""), ("ready", "compute"),
    ]  # fmt: skip


def test_what_another_process_says_in_its_name_is_not_believed(tmp_path: Path) -> None:
    liar = actor(tmp_path, "b", 'NAME = "a"; tell("compute"); NAME = "b"; ' + STEADY)
    silent = actor(tmp_path, "a", "wait()", start_timeout_s=0.5)
    assert Run(tmp_path, silent, liar).run() == Outcome(1, "failed: a")
