"""Stored logs: what is written is read again, and the limits hold."""

from __future__ import annotations

import os
import resource
import time
from datetime import datetime
from pathlib import Path

import pytest

from robocomp_dsl.deploy import log_runs
from robocomp_dsl.deploy.log_filter import LogFilter, parse_since
from robocomp_dsl.deploy.log_runs import LogRun
from robocomp_dsl.deploy.log_store import MAX_RUNS, LogLimits, LogStore
from robocomp_dsl.deploy.logs import LogRecord
from tests.support.waiting import wait_until

ENOUGH = LogLimits(size=1_000_000)


@pytest.fixture(autouse=True)
def state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path / "state"


def run_of(name: str = "app") -> LogRun:
    return LogRun(name, "/app.ddsl", "domain", os.getpid(), time.time(), ("arm", "eye"))


def record(number: int, text: str = "") -> LogRecord:
    return LogRecord(float(number), "arm", "INFO", text or f"line {number}", sequence=number)


def store_of(*records: LogRecord, name: str = "app", limits: LogLimits = ENOUGH) -> Path:
    store = LogStore(run_of(name), limits)
    for entry in records:
        store.record(entry)
    store.close(0, "test")
    return store.folder


def test_log_store_keeps_what_it_gets(state: Path) -> None:
    records = [record(1), record(2, "two\nlines \x00 größe"), record(3, "\udcff"[:0] + "x" * 70000)]
    folder = store_of(*records)
    assert folder == state / "robocomp" / "logs" / "app" / "000001"
    assert list(log_runs.read_records(folder)) == records
    run = log_runs.read_description(folder)
    assert run is not None
    assert (run.code, run.reason, run.components) == (0, "test", ("arm", "eye"))
    assert run.ended is not None
    assert [f.stat().st_mode & 0o77 for f in log_runs.segments(folder)] == [0]


def test_log_store_writes_at_once_and_half_a_line_does_no_harm() -> None:
    store = LogStore(run_of(), ENOUGH)
    store.record(record(1))
    # Read while it is being written: what is in the file survives a kill of the process.
    wait_until(lambda: list(log_runs.read_records(store.folder)) == [record(1)])
    description = log_runs.read_description(store.folder)
    assert description is not None
    assert description.ended is None
    with log_runs.segments(store.folder)[0].open("a") as file:
        file.write('{"time": 2.0, "component": "arm", "lev')
    assert list(log_runs.read_records(store.folder)) == [record(1)]
    store.close(0, "test")


def test_log_store_is_bounded_in_size_across_runs() -> None:
    limits = LogLimits(size=20_000)
    folders = [store_of(*(record(i) for i in range(1, 101)), limits=limits) for _ in range(6)]

    def total() -> int:
        return sum(f.stat().st_size for folder in folders for f in log_runs.segments(folder))

    assert 10_000 < total() <= limits.size
    assert not folders[0].exists()
    assert list(log_runs.read_records(folders[-1]))[-1] == record(100)
    # One run alone is bounded, too, and keeps the newest.
    folder = store_of(*(record(i) for i in range(1, 2001)), limits=limits)
    assert sum(f.stat().st_size for f in log_runs.segments(folder)) <= limits.size
    left = list(log_runs.read_records(folder))
    assert left == [record(i) for i in range(left[0].sequence, 2001)]
    assert log_runs.run_folders("app") == [folder]


def test_log_store_deletes_by_age_and_number(monkeypatch: pytest.MonkeyPatch) -> None:
    old, other = store_of(record(1)), store_of(record(1), name="other")
    alive = LogStore(run_of("quiet"), ENOUGH)
    for folder in (old, other, alive.folder):
        for path in (*folder.iterdir(), folder):
            os.utime(path, (1.0, 1.0))
    new = store_of(record(2))
    # `close` waits a limited time for the thread that deletes: a busy disk may take longer.
    wait_until(lambda: log_runs.run_folders("app") == [new])
    wait_until(lambda: log_runs.stored_names() == ["app", "quiet"])
    alive.close(0, "")
    for number in range(100, 100 + MAX_RUNS):
        (new.parent / f"{number:06d}").mkdir()
    store_of(record(3))
    folders = wait_until(
        lambda: len(found := log_runs.run_folders("app")) == MAX_RUNS and found,
    )
    assert int(folders[-1].name) == 100 + MAX_RUNS


def test_log_store_counts_what_a_full_disk_refuses() -> None:
    warnings: list[str] = []
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    store = LogStore(run_of(), ENOUGH)
    store.attach(warnings.append)
    store.record(record(1))
    size = wait_until(lambda: sum(f.stat().st_size for f in log_runs.segments(store.folder)))
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        for number in (2, 3, 4):
            store.record(record(number))
            wait_until(lambda count=number - 1: store._output.dropped == count)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    store.record(record(5))
    store.close(0, "test")
    texts = [r.text for r in log_runs.read_records(store.folder)]
    assert texts == ["line 1", "… 3 lines were dropped: File too large", "line 5"]
    assert len(warnings) == 1
    assert "refuses log lines (File too large)" in warnings[0]


def test_log_store_state_folder_that_cannot_be_used(state: Path) -> None:
    state.mkdir()
    (state / "robocomp").write_text("in the way")
    with pytest.raises(OSError, match="robocomp"):
        LogStore(run_of(), ENOUGH)
    assert log_runs.stored_names() == []
    assert log_runs.run_folders("app") == []


@pytest.mark.parametrize(
    ("text", "moment"),
    [
        ("10 min", "2026-11-22 20:05:00"),
        ("90s", "2026-11-22 20:13:30"),
        ("1.5 h", "2026-11-22 18:45:00"),
        ("2 d", "2026-11-20 20:15:00"),
        ("20:10", "2026-11-22 20:10:00"),
        ("20:16:30", "2026-11-21 20:16:30"),
        ("2026-11-01", "2026-11-01 00:00:00"),
        ("2026-11-01T08:30", "2026-11-01 08:30:00"),
        ("2026-11-01 08:30:01", "2026-11-01 08:30:01"),
    ],
)
def test_log_filter_times(text: str, moment: str) -> None:
    now = datetime.fromisoformat("2026-11-22 20:15:00").timestamp()
    assert parse_since(text, now) == datetime.fromisoformat(moment).timestamp()


@pytest.mark.parametrize("text", ["", "yesterday", "10 years", "25:00", "-3 min"])
def test_log_filter_times_that_are_none(text: str) -> None:
    with pytest.raises(ValueError, match="is no time"):
        parse_since(text, 0.0)


def test_log_filter_levels() -> None:
    levels = ("DEBUG", "", "INFO", "WARNING", "ERROR", "CRITICAL", "NOTICE")
    matched = {
        level: [n for n in levels if LogFilter(level=level).matches(LogRecord(0.0, "a", n, ""))]
        for level in ("debug", "info", "error")
    }
    assert matched["debug"] == list(levels)
    assert matched["info"] == [*levels[1:]]
    assert matched["error"] == ["ERROR", "CRITICAL"]
