"""What units run beside components: readiness of programs, bounded logs, watched limits."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from robocomp_dsl.host_tools import trim_logs, wait_until_ready
from robocomp_dsl.host_tools.watch_limits import WatchedUnit, log_line
from tests.support.waiting import wait_until

MARK = '{"time": 1.5, "level": "INFO", "message": "starting"}\n'


def in_thread(call: object, *arguments: object) -> threading.Thread:
    assert callable(call)
    thread = threading.Thread(target=call, args=arguments, daemon=True)
    thread.start()
    return thread


def test_wait_until_ready_finds_line_since_last_start(tmp_path: Path) -> None:
    log = tmp_path / "x.log"
    log.write_text(f"{MARK}listening on 1\n{'x' * 200_000}\n{MARK}hello\n")
    thread = in_thread(wait_until_ready.wait_for_line, log, "listening on [0-9]+")
    thread.join(0.2)
    assert thread.is_alive()
    with log.open("a") as output:
        output.write("listening on 2\n")
    wait_until(lambda: not thread.is_alive(), "the line was not found")


def test_wait_until_ready_without_mark_reads_all(tmp_path: Path) -> None:
    log = tmp_path / "x.log"
    log.write_text("ready\n")
    assert wait_until_ready.last_start(log) == 0
    wait_until_ready.main(["log", str(log), "^ready$"])


def test_wait_until_ready_finds_port() -> None:
    with socket.socket() as server:
        server.bind(("127.0.0.1", 0))
        port = server.getsockname()[1]
        thread = in_thread(wait_until_ready.wait_for_port, port)
        server.listen()
        wait_until(lambda: not thread.is_alive(), "the port was not found")


def test_wait_until_ready_rejects_other_arguments() -> None:
    with pytest.raises(SystemExit):
        wait_until_ready.main(["soon"])


def test_trim_logs_keeps_offsets(tmp_path: Path) -> None:
    log = tmp_path / "left/arm.log"
    log.parent.mkdir()
    lines = b"".join(b"%07d\n" % number for number in range(500_000))
    log.write_bytes(lines)
    trim_logs.trim_folder(tmp_path, 2_000_000)
    status = log.stat()
    if status.st_size:  # the file system can punch holes
        assert status.st_size == len(lines)
        assert status.st_blocks * 512 <= 2_000_000
        assert log.read_bytes()[-1_000_000:] == lines[-1_000_000:]
    with log.open("ab") as output:
        output.write(b"last\n")
    assert log.read_bytes().endswith(b"last\n")


def test_trim_logs_leaves_small_files(tmp_path: Path) -> None:
    log = tmp_path / "arm.log"
    log.write_bytes(b"x" * 100_000)
    trim_logs.trim_folder(tmp_path, 10)
    assert log.read_bytes() == b"x" * 100_000


def test_watched_unit_reports_exceeded_memory(tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as process:
        watched = WatchedUnit("x.service", "arm", 1, 0.0)
        wait_until(lambda: watched.check(process.pid) or watched.tracker, "no sample")
        texts = watched.check(process.pid) or [("memory", False)]
        assert "memory" in texts[0][0]
        assert watched.check(0) == []
        process.communicate(b"\n")
    assert WatchedUnit("x.service", "arm", 0, 0.0).check(os.getpid()) == []
    log_line(tmp_path, watched, "ERROR", "uses too much")
    assert '"message": "uses too much"' in (tmp_path / "arm.log").read_text()
