"""What the components of one process print."""

from __future__ import annotations

import io
from pathlib import Path

import pytest

from robocomp_dsl.deploy.logs import LineSplitter
from robocomp_dsl.runtime.component import thread_context
from robocomp_dsl.runtime.component.thread_context import ThreadContext
from robocomp_dsl.runtime.group_process.member_output import MemberOutput


def test_member_output_says_who_printed(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = io.StringIO()
    output = MemberOutput(stream, "stdout")
    print("the process", file=output)
    for name, text in (("arm", "two\nlines, "), ("eye", "other"), ("arm", "joined é\n")):
        context = ThreadContext(name, Path(), -1)
        monkeypatch.setattr(thread_context._local, "context", context, raising=False)
        output.write(text)
    output.finish()
    splitter = LineSplitter("group", "stdout", ["arm", "eye"])
    records = splitter.feed(stream.getvalue().encode(), 1.0)
    assert [(r.component, r.level, r.text, r.stream) for r in records] == [
        ("group", "", "the process", "stdout"),
        ("arm", "", "two", "stdout"),
        ("arm", "", "lines, joined é", "stdout"),
        ("eye", "", "other", "stdout"),
    ]
