"""Requests to start, stop and restart components of a running deployment."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import replace
from pathlib import Path

import pytest

from robocomp_dsl.deploy.plan import Plan, Process
from robocomp_dsl.deploy.supervisor.requests import ComponentRequests, PlanRejected
from robocomp_dsl.deploy.supervisor.run_options import Options, Outcome
from robocomp_dsl.model.deployment import Restart
from tests.deploy.scripted_processes import STEADY, make_plan, scripted_process
from tests.deploy.supervisor_run import SupervisorRun, stop

NEVER = Restart("never")


class RequestRun(SupervisorRun):
    """A run in which `steps` act when the text `begin_at` appears; then it stops."""

    def __init__(self, tmp_path: Path, *processes: Process, options: Options | None = None) -> None:
        patient = Options(grace_s=60.0, stop_timeout_s=60.0)  # a busy machine kills nothing
        super().__init__(tmp_path, *processes, options=options or patient)

    replies: list[str]
    replanned: Callable[[], tuple[Plan, str]] | None = None

    def play(
        self, begin_at: str, steps: Callable[[RequestRun], Awaitable[None]], *, ends: bool = True
    ) -> Outcome:
        self.replies = []
        self.errors: list[BaseException] = []

        async def act() -> None:
            self.requests = ComponentRequests(self.engine, self.replanned)
            try:
                await steps(self)
            except BaseException as error:
                self.errors.append(error)
                raise
            finally:
                if ends or self.errors:
                    self.engine.stop("test")

        def begin(_: SupervisorRun) -> None:
            self.task = asyncio.get_running_loop().create_task(act())

        outcome = self.on(begin_at, begin).run()
        if self.errors:
            raise self.errors[0]
        return outcome

    async def request(self, verb: str, *names: str) -> bool:
        async def notify(text: str) -> None:
            self.replies.append(text)

        return await asyncio.wait_for(self.requests.handle(verb, names, notify), 60)

    def pids(self) -> dict[str, int]:
        return {row.name: row.pid for row in self.engine.statuses()}


def chain(tmp_path: Path, body: str = STEADY) -> list[Process]:
    """`base`, then `nav` (in group `g`) after it, then `log` after `nav`."""
    return [
        scripted_process(tmp_path, "base", body, stops_after=("g-nav", "log")),
        scripted_process(tmp_path, "g-nav", body, after=("base",), stops_after=("log",), group="g"),
        scripted_process(tmp_path, "log", body, after=("g-nav",)),
    ]


def test_requests_stop_one_component_and_start_it_again(tmp_path: Path) -> None:
    run = RequestRun(tmp_path, *chain(tmp_path))

    async def steps(run: RequestRun) -> None:
        before = run.pids()
        assert await run.request("stop", "g-nav")
        assert run.replies == ["g-nav: stopped", "still running without it: log"]
        assert run.row("g-nav").state == "exited"
        assert await run.request("stop", "g-nav")
        assert run.replies[2] == "g-nav: was not running"
        assert await run.request("start", "g-nav")
        after = run.pids()
        assert run.replies[-1] == f"g-nav: ready (pid {after['g-nav']})"
        assert after["g-nav"] != before["g-nav"]
        assert (after["base"], after["log"]) == (before["base"], before["log"])
        assert await run.request("start", "log")
        assert run.replies[-1] == "log: is already running"

    assert run.play("all 3 components are ready", steps) == Outcome(0, "test")


def test_requests_restart_in_order(tmp_path: Path) -> None:
    run = RequestRun(tmp_path, *chain(tmp_path, 'print("began"); ' + STEADY))

    async def steps(run: RequestRun) -> None:
        run.records.clear()
        assert await run.request("restart", "log", "g", "base")

    assert run.play("all 3 components are ready", steps).code == 0
    order = ["log: finalized", "g-nav: finalized", "base: finalized", "base: began",
             "base is ready", "g-nav: began", "g-nav is ready", "log: began"]  # fmt: skip
    places = [run.at(text) for text in order]
    assert places == sorted(places)


def test_requests_all_stopped_the_deployment_continues(tmp_path: Path) -> None:
    run = RequestRun(tmp_path, *chain(tmp_path))

    async def steps(run: RequestRun) -> None:
        assert await run.request("stop")
        assert set(run.pids().values()) == {0}
        # `log` needs the two others, so they start before it.
        assert await run.request("start", "log")
        assert [row.state for row in run.engine.statuses()] == ["ready"] * 3

    assert run.play("all 3 components are ready", steps) == Outcome(0, "test")


def test_requests_start_after_restarts_were_given_up(tmp_path: Path) -> None:
    fixed = tmp_path / "fixed"
    body = f"if not os.path.exists({str(fixed)!r}): sys.exit(3)\n" + STEADY
    bad = scripted_process(tmp_path, "a", body, restart=Restart(max=1))
    keep_going = Options(keep_going=True, grace_s=60.0, stop_timeout_s=60.0)
    run = RequestRun(tmp_path, bad, scripted_process(tmp_path, "b", STEADY), options=keep_going)

    async def steps(run: RequestRun) -> None:
        # A start that fails again leaves the deployment running, for the next attempt.
        assert not await run.request("start", "a")
        assert run.replies[-1] == "a: failed: exit code 3"
        fixed.touch()
        assert await run.request("start", "a")
        assert run.row("a").state == "ready"
        assert run.row("a").restarts == 0

    assert run.play("a failed permanently", steps) == Outcome(0, "test")


def test_requests_a_restart_that_fails_does_not_stop_the_others(tmp_path: Path) -> None:
    broken = tmp_path / "broken"
    body = f"if os.path.exists({str(broken)!r}): sys.exit(3)\n" + STEADY
    run = RequestRun(tmp_path, scripted_process(tmp_path, "a", body, restart=NEVER))

    async def steps(run: RequestRun) -> None:
        broken.touch()
        assert not await run.request("restart", "a")
        assert run.row("a").state == "failed"
        broken.unlink()
        assert await run.request("restart", "a")

    assert run.play("the component is ready", steps) == Outcome(0, "test")


def test_requests_run_the_description_as_it_is_now(tmp_path: Path) -> None:
    old = chain(tmp_path)
    changed = replace(old[0], env=(("MODE", "new"),))
    body = 'print("mode", os.environ["MODE"]); ' + STEADY
    (tmp_path / "base.py").write_text((tmp_path / "base.py").read_text().replace(STEADY, body))
    added = scripted_process(tmp_path, "extra", STEADY, after=("base",))
    new = [changed, replace(old[1], env=(("X", "1"),)), added]
    run = RequestRun(tmp_path, *(replace(p, env=(("MODE", "old"),)) for p in old))
    run.replanned = lambda: (make_plan(tmp_path, *new), "warning: something")

    async def steps(run: RequestRun) -> None:
        assert await run.request("restart", "base")
        assert run.replies == [
            "warning: something", "base: stopped", f"base: ready (pid {run.pids()['base']})",
            "the file has changed these, too; restart them: g-nav",
        ]  # fmt: skip
        assert await run.request("start", "extra")
        assert run.row("extra").state == "ready"
        assert not await run.request("restart", "log")
        assert run.replies[-1] == "demo.ddsl no longer has log; it can only be stopped"
        assert await run.request("stop", "log")

    assert run.play("all 3 components are ready", steps) == Outcome(0, "test")
    assert run.texts("base") == ["mode old", "finalized", "mode new", "finalized"]


def test_requests_errors_in_the_description_stop_nothing(tmp_path: Path) -> None:
    def reject() -> tuple[Plan, str]:
        raise PlanRejected("demo.ddsl has errors; nothing was changed")

    run = RequestRun(tmp_path, *chain(tmp_path))
    run.replanned = reject

    async def steps(run: RequestRun) -> None:
        before = run.pids()
        assert not await run.request("restart", "log")
        assert run.replies == ["demo.ddsl has errors; nothing was changed"]
        assert not await run.request("stop", "g-nva")
        assert "no component or group `g-nva`" in run.replies[-1]
        assert "did you mean `g-nav`?" in run.replies[-1]
        assert run.pids() == before

    assert run.play("all 3 components are ready", steps).code == 0


def test_requests_end_when_the_deployment_stops(tmp_path: Path) -> None:
    slow = scripted_process(tmp_path, "a", STEADY)
    run = RequestRun(tmp_path, slow, scripted_process(tmp_path, "b", STEADY))

    async def steps(run: RequestRun) -> None:
        script = tmp_path / "a.py"
        script.write_text(script.read_text().replace('report("compute")', 'print("not ready")'))
        run.on("a: not ready", stop)
        assert not await run.request("restart", "a")
        assert not await run.request("start", "a")
        assert run.replies[-1] == "the deployment is stopping; nothing was done"

    assert run.play("all 2 components are ready", steps, ends=False) == Outcome(0, "test")


@pytest.mark.parametrize("verb", ["start", "restart"])
def test_requests_of_an_unknown_name_list_the_names(tmp_path: Path, verb: str) -> None:
    run = RequestRun(tmp_path, *chain(tmp_path))

    async def steps(run: RequestRun) -> None:
        assert not await run.request(verb, "camera")
        assert run.replies[-1].endswith("it has base, g-nav, log, g")

    assert run.play("all 3 components are ready", steps).code == 0
