"""Output of `rcdeploy`: log lines, the table below them, and slow or absent readers."""

from __future__ import annotations

import io
import os
import resource
import threading
from pathlib import Path
from typing import TextIO

import pytest

from robocomp_dsl.cli.rcdeploy import terminal as rcdeploy_terminal
from robocomp_dsl.cli.rcdeploy.terminal import Terminal
from robocomp_dsl.deploy.logs import LogRecord
from robocomp_dsl.deploy.status import READY, ProcessStatus
from tests.support.waiting import wait_until


def record(text: str, component: str = "arm") -> LogRecord:
    return LogRecord(0.0, component, "INFO", text)


def ignore(_: str) -> None:
    pass


class BlockingStream(io.StringIO):
    """A stream whose writer can be blocked, as Ctrl-S blocks a terminal."""

    encoding = "ascii"

    def __init__(self) -> None:
        super().__init__()
        self.free = threading.Event()
        self.free.set()
        self.asked = threading.Event()
        self.news = threading.Condition()

    def write(self, text: str) -> int:
        self.asked.set()
        self.free.wait()
        with self.news:
            self.news.notify_all()
            return super().write(text)

    def wait_for(self, text: str) -> None:
        with self.news:
            assert self.news.wait_for(lambda: text in self.getvalue(), 20), self.getvalue()


def terminal(stream: TextIO, *, live: bool = False, as_json: bool = False) -> Terminal:
    return Terminal(stream, ["arm"], live=live, colours=False, as_json=as_json)


def test_terminal_prints_lines_in_order() -> None:
    stream = BlockingStream()
    shown = terminal(stream)
    for text in ("one", "größe", "a\nb"):
        shown.record(record(text))
    shown.close()
    lines = [line.partition(" ")[2] for line in stream.getvalue().splitlines()]
    assert [line.split("| ")[1] for line in lines] == ["one", "gr\\xf6\\xdfe", "a", "b"]
    assert lines[0].startswith("arm      |")


def test_terminal_prints_json_record_per_line() -> None:
    stream = BlockingStream()
    shown = terminal(stream, as_json=True)
    records = [record("one"), record("two\nlines", "eye")]
    for entry in records:
        shown.record(entry)
    shown.close()
    assert [LogRecord.from_json(line) for line in stream.getvalue().splitlines()] == records


def test_terminal_redraws_table_below_lines_and_removes_it() -> None:
    stream = BlockingStream()
    shown = terminal(stream, live=True)
    rows = [ProcessStatus("arm", READY, 4711, 1.0), ProcessStatus("eye", READY, 4712, 1.0)]
    shown.attach(lambda: rows, ignore, ignore)
    shown.changed()
    stream.wait_for("4712")
    shown.record(record("hello"))
    stream.wait_for("hello")
    shown.close()
    text = stream.getvalue()
    assert text.index("4712") < text.index("\x1b[3F\x1b[J") < text.index("hello")
    assert text.rstrip("\n").rsplit("\x1b[3F\x1b[J", 1)[1] == ""


def test_blocked_terminal_drops_and_counts_lines() -> None:
    stream = BlockingStream()
    stream.free.clear()
    shown = terminal(stream)
    shown.record(record("first"))
    assert stream.asked.wait(20)
    for i in range(rcdeploy_terminal.MAX_QUEUED_LINES + 10):
        shown.record(record(f"line {i}"))
    stream.free.set()
    stream.wait_for(f"line {rcdeploy_terminal.MAX_QUEUED_LINES + 9}")
    shown.close()
    text = stream.getvalue()
    counted = sum(int(line.split()[1]) for line in text.splitlines() if "too slow" in line)
    assert counted == 10
    assert len(text.splitlines()) == 1 + 1 + rcdeploy_terminal.MAX_QUEUED_LINES


def test_terminal_stops_deployment_when_reader_is_gone() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    reader_gone = threading.Event()
    with os.fdopen(writer, "w") as stream:
        shown = Terminal(stream, ["arm"], live=False, colours=False, as_json=False)
        shown.attach(list, lambda _: reader_gone.set(), ignore)
        shown.record(record("nobody reads this"))
        assert reader_gone.wait(20)
        shown.close()
        # What is still in the buffer has nowhere to go.
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def test_terminal_shortens_table_of_many_components(tmp_path: Path) -> None:
    stream = BlockingStream()
    shown = terminal(stream, live=True)
    shown.attach(lambda: [ProcessStatus(f"c{i}", READY, i + 1) for i in range(100)], ignore, ignore)
    shown.changed()
    stream.wait_for("more (rcdeploy status)")
    shown.close()
    assert "c99" not in stream.getvalue()


def test_terminal_on_a_full_disk_goes_on_and_says_it(tmp_path: Path) -> None:
    warnings: list[str] = []
    with Path("/dev/full").open("w") as stream:
        shown = terminal(stream)
        shown.attach(list, lambda reason: warnings.append(f"aborted: {reason}"), warnings.append)
        for i in range(3):
            shown.record(record(f"line {i}"))
            wait_until(lambda count=i + 1: shown._output.dropped == count)
        shown.close()
    reason = "No space left on device"
    assert warnings == [
        f"standard output refuses log lines ({reason}); they are dropped until it takes them"
    ]
    assert shown._output.dropped == 3


@pytest.mark.parametrize("as_json", [False, True])
def test_terminal_resumes_when_there_is_space_again(tmp_path: Path, as_json: bool) -> None:
    file = tmp_path / "log"
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    with file.open("w") as stream:
        shown = terminal(stream, as_json=as_json)
        shown.attach(list, ignore, ignore)
        shown.record(record("before"))
        size = wait_until(lambda: file.stat().st_size)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size + 10, hard))
        try:
            for i in range(4):
                shown.record(record(f"lost {i}"))
                wait_until(lambda count=i + 1: shown._output.dropped == count)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
        shown.record(record("after"))
        shown.close()
    lines = file.read_text().splitlines()
    assert len(lines) == 4  # the second one is the part of a line for which there was space
    assert "… 4 lines were dropped: File too large" in lines[2]
    assert [text in line for text, line in zip(("before", "after"), lines[::3], strict=True)]
    if as_json:
        assert LogRecord.from_json(lines[2]).component == "rcdeploy"
        assert LogRecord.from_json(lines[3]).text == "after"
