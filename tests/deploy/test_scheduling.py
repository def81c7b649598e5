"""CPU cores and real-time priority of the processes that the embedded supervisor starts."""

from __future__ import annotations

import os
import resource
from pathlib import Path

import pytest

from robocomp_dsl.deploy.supervisor.scheduling import scheduling_error, with_scheduling
from robocomp_dsl.model.deployment import ResourceLimits, Restart
from tests.deploy.scripted_processes import scripted_process
from tests.deploy.supervisor_run import SupervisorRun

SHOW = "print(sorted(os.sched_getaffinity(0)), os.sched_getscheduler(0),"
SHOW += " os.sched_getparam(0).sched_priority)"
CORE = min(os.sched_getaffinity(0))


def shown_by(tmp_path: Path, limits: ResourceLimits) -> list[str]:
    process = scripted_process(tmp_path, "a", SHOW, limits=limits, restart=Restart("never"))
    run = SupervisorRun(tmp_path, process)
    run.run()
    return run.texts("a")


def test_supervisor_starts_process_on_its_cores(tmp_path: Path) -> None:
    before = os.sched_getaffinity(0)
    assert shown_by(tmp_path, ResourceLimits(cores=(CORE,))) == [f"[{CORE}] {os.SCHED_OTHER} 0"]
    assert os.sched_getaffinity(0) == before


def test_supervisor_starts_process_with_realtime_priority(tmp_path: Path) -> None:
    limits = ResourceLimits(realtime=7)
    if problem := scheduling_error(limits):
        pytest.skip(problem)
    cores = sorted(os.sched_getaffinity(0))
    assert shown_by(tmp_path, limits) == [f"{cores} {os.SCHED_FIFO} 7"]
    assert os.sched_getscheduler(0) == os.SCHED_OTHER


def test_scheduling_error_names_missing_cores() -> None:
    usable = max(os.sched_getaffinity(0))
    assert scheduling_error(ResourceLimits(cores=(CORE,))) == ""
    for cores in ((1022, 1023), (CORE, 1022, 1023)):
        problem = scheduling_error(ResourceLimits(cores=cores))
        assert problem.startswith("the CPU cores 1022-1023 cannot be used; this machine offers ")
        assert str(usable) in problem


def test_scheduling_error_of_user_without_permission() -> None:
    read_end, write_end = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            resource.setrlimit(resource.RLIMIT_RTPRIO, (0, 0))
            if os.geteuid() == 0:
                os.setuid(65534)
            os.write(write_end, scheduling_error(ResourceLimits(realtime=50)).encode())
        finally:
            os._exit(0)
    os.close(write_end)
    with os.fdopen(read_end) as answer:
        assert answer.read() == "`realtime priority 50` is not permitted: Operation not permitted"
    os.waitpid(child, 0)


def test_process_that_may_not_be_scheduled_is_not_started(tmp_path: Path) -> None:
    started = tmp_path / "started"
    with pytest.raises(OSError, match="Invalid argument"):
        with_scheduling(ResourceLimits(cores=(1023,)), started.touch)
    assert not started.exists()
