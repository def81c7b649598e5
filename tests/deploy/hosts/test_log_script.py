"""The script that sends log files: where it begins, and what it sends."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.deploy.hosts import log_script
from robocomp_dsl.deploy.hosts.denials import latest_denial
from robocomp_dsl.deploy.hosts.host_logs import SCRIPT
from robocomp_dsl.deploy.hosts.log_records import FileRecords
from robocomp_dsl.host_tools import trim_logs


def line(number: int) -> str:
    return json.dumps({"time": float(number), "level": "INFO", "message": f"m{number}"}) + "\n"


@pytest.fixture
def root(tmp_path: Path) -> Path:
    (tmp_path / "logs/left").mkdir(parents=True)
    return tmp_path


def send(root: Path, **fields: Any) -> dict[str, tuple[int, bytes]]:
    """Offset and content by component, as the script sends them in one pass."""
    request = {"root": str(root), "components": [], "offsets": {}, "last": -1, "since": 0.0}
    command = [
        sys.executable,
        "-c",
        SCRIPT.read_text(),
        json.dumps({**request, "follow": False, **fields}),
    ]
    output = subprocess.run(command, capture_output=True, check=True).stdout
    found: dict[str, tuple[int, bytes]] = {}
    while output:
        head, _, output = output.partition(b"\n")
        frame = json.loads(head)
        if "component" in frame:
            offset, data = found.get(frame["component"], (frame["offset"], b""))
            found[frame["component"]] = (offset, data + output[: frame["length"]])
            output = output[frame["length"] :]
    return found


def test_log_script_sends_whole_lines(root: Path) -> None:
    (root / "logs/arm.log").write_text(line(1) + line(2) + "incompl")
    (root / "logs/left/eye.log").write_text("é\n")
    found = send(root)
    assert found["arm"] == (0, (line(1) + line(2)).encode())
    assert found["left/eye"] == (0, "é\n".encode())
    assert set(send(root, components=["arm"])) == {"arm"}
    offset = len(line(1))
    assert send(root, offsets={"arm": offset})["arm"] == (offset, line(2).encode())


def test_log_script_finds_last_lines_and_time(root: Path) -> None:
    lines = [line(number) for number in range(20_000)]
    (root / "logs/arm.log").write_text("".join(lines))
    assert send(root, last=2)["arm"][1].decode() == "".join(lines[-2:])
    assert "arm" not in send(root, last=0)
    text = send(root, since=15_000.0)["arm"][1].decode()
    first = json.loads(text.splitlines()[0])["time"]
    assert 13_000 < first <= 15_000
    assert text.endswith(lines[-1])


def test_log_script_skips_holes(root: Path) -> None:
    log = root / "logs/arm.log"
    lines = [line(number) for number in range(60_000)]
    log.write_text("".join(lines))
    trim_logs.trim_folder(root / "logs", 1_000_000)
    offset, data = send(root).get("arm", (0, b""))
    if log.stat().st_size:  # the file system can punch holes
        assert offset > 0
        assert data.decode().splitlines(keepends=True) == lines[-data.count(b"\n") :]


def test_log_script_begins_again_with_a_shorter_file(root: Path) -> None:
    (root / "logs/arm.log").write_text(line(1))
    assert send(root, offsets={"arm": 10_000})["arm"] == (0, line(1).encode())


def test_log_script_reads_times() -> None:
    assert log_script.line_time(line(3).encode()) == 3.0
    for text in (b"", b"{", b"{}", b'{"time": []}', b"hello"):
        assert log_script.line_time(text) is None


def test_file_records_date_lines_without_time() -> None:
    records = FileRecords("arm", "robot")
    text = line(5) + "printed\n" + line(7) + '{"time": "x", "level": "INFO", "message": "y"}\n'
    found = records.feed(text.encode(), 100.0)
    assert [(r.time, r.text, r.host) for r in found] == [
        (5.0, "m5", "robot"),
        (5.0, "printed", "robot"),
        (7.0, "m7", "robot"),
        (7.0, "y", "robot"),
    ]
    records.arrived(9.0)
    assert records.feed(b"now\n", 100.0)[0].time == 9.0
    assert records.feed(b"", 0.0) == []


def test_denial_is_described_with_its_age() -> None:
    def warning(at: float, text: str) -> str:
        return json.dumps({"time": at, "level": "WARNING", "message": text}) + "\n"

    log = f"cut line\n{warning(10.0, 'denied: eye publishes x')}{warning(40.0, 'slow')}"
    assert latest_denial("router.robot", log, 52.0) == "42.0 s ago: denied: eye publishes x"
    assert latest_denial("router.robot", log, 9999.0) == ""
    assert latest_denial("router.robot", "", 1.0) == ""
