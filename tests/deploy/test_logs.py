"""Log records: splitting of output into lines, time stamps, and text form."""

from __future__ import annotations

import json

import pytest

from robocomp_dsl.deploy import logs

CHUNKS = [
    # what arrives, the texts of the records
    ([b"a\nb\n"], ["a", "b"]),
    ([b"a", b"b\nc"], ["ab", "c"]),
    ([b"\n\nx"], ["", "", "x"]),
    ([b"dos\r\n"], ["dos"]),
    ([b"\xff\n"], ["\N{REPLACEMENT CHARACTER}"]),
    (["größe".encode()[:3], "größe".encode()[3:]], ["größe"]),
    ([b'{"message": "m", "level": "info"}\n'], ["m"]),
    ([b'{"message": "m", "level": "error", "exception": "Trace"}\n'], ["m\nTrace"]),
    ([b'{"message": "no level"}\n'], ['{"message": "no level"}']),
    ([b'{"broken\n'], ['{"broken']),
    ([b"{" * 5000 + b"\n"], ["{" * 5000]),
    ([b'{"message": "m", "level": "info", "time": 1e999}\n'], ["m"]),
    ([], []),
]


@pytest.mark.parametrize(("chunks", "texts"), CHUNKS)
def test_line_splitter_splits_chunks_into_records(chunks: list[bytes], texts: list[str]) -> None:
    lines = logs.LineSplitter("c", "stdout")
    found = [record for chunk in chunks for record in lines.feed(chunk, 5.0)] + lines.end(5.0)
    assert [record.text for record in found] == texts
    assert all(record.time == 5.0 for record in found)
    assert [logs.LogRecord.from_json(record.to_json()) for record in found] == found


@pytest.mark.parametrize("size", [1, 7, 4096, 100_000])
def test_line_splitter_splits_long_lines_without_loss(size: int) -> None:
    data = ("ä" * 100_000 + "\n" + "€" * 50_001).encode()
    lines = logs.LineSplitter("c", "stdout")
    texts = [
        record.text
        for at in range(0, len(data), size)
        for record in lines.feed(data[at : at + size], 0.0)
    ] + [record.text for record in lines.end(0.0)]
    assert "".join(texts) == "ä" * 100_000 + "€" * 50_001
    assert all(len(text.encode()) <= logs.MAX_LINE_BYTES for text in texts)


def test_line_splitter_ignores_implausible_log_time() -> None:
    for stamp, believed in ((1000.25, 1000.25), (5e9, 1001.0), ("noon", 1001.0)):
        line = json.dumps({"message": "m", "level": "INFO", "time": stamp}).encode() + b"\n"
        assert logs.LineSplitter("c", "stdout").feed(line, 1001.0)[0].time == believed


def test_format_record_escapes_and_indents_text() -> None:
    record = logs.LogRecord(3600.0625, "arm", "WARNING", "hot\x1b[2J\a\nsecond \x1b[31mred")
    shown = logs.format_record(record, 6, colours=False)
    stamp, _, rest = shown.partition(" ")
    assert stamp.endswith(":00:00.062")
    assert rest == (
        "arm    | warning: hot\N{REPLACEMENT CHARACTER}[2J\N{REPLACEMENT CHARACTER}\n"
        + " " * 20 + "| second \x1b[31mred"
    )  # fmt: skip
    coloured = logs.format_record(record, 6, colours=True)
    assert "\x1b[33mwarning: hot" in coloured
    assert f"\x1b[{logs.colour_of('arm')}marm   \x1b[0m" in coloured
