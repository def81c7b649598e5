"""The working folders of the components of one process."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeVar

import pytest

from robocomp_dsl.runtime.component import thread_context
from robocomp_dsl.runtime.component.thread_context import (
    create_context,
    current_context,
    inherit_contexts,
    own_folder,
    within,
)

T = TypeVar("T")


@pytest.fixture(autouse=True)
def _thread_start(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Threads of other tests start as before, and contexts are forgotten."""
    monkeypatch.setattr(threading.Thread, "start", threading.Thread.start)
    monkeypatch.setattr(thread_context, "_contexts", {})
    yield
    for context in thread_context._contexts.values():
        os.close(context.folder)


def in_thread(call: Callable[[], T]) -> T:
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(call).result()


def where() -> tuple[str, str]:
    """The component of the current thread, and its working folder by a relative path."""
    context = current_context()
    return (context.name if context else "", Path("name").read_text())


@pytest.fixture
def folders(tmp_path: Path) -> Path:
    for name in ("arm", "eye"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "name").write_text(name)
        create_context(name, tmp_path / name)
    return tmp_path


def test_own_folder_is_that_of_the_threads_of_one_component(folders: Path) -> None:
    inherit_contexts()
    before = Path.cwd()

    def run() -> list[tuple[str, str]]:
        context = thread_context.context_of("arm")
        assert context
        assert own_folder(context)
        return [where(), in_thread(where)]

    assert in_thread(run) == [("arm", "arm")] * 2
    assert Path.cwd() == before != folders / "arm"


def test_within_calls_handler_in_the_folder_of_its_component(folders: Path) -> None:
    del folders
    inherit_contexts()

    def handler(arguments: tuple[str, ...]) -> tuple[object, ...]:
        return (*arguments, where(), in_thread(where))

    call = within(handler, "eye", "arm")
    same = within(handler, "arm", "arm")
    assert same is handler

    def run() -> list[object]:
        context = thread_context.context_of("arm")
        assert context
        own_folder(context)
        here = ("arm", "arm")
        other = in_thread(lambda: (call(("x",)), where()))
        assert other == (("x", ("eye", "eye"), ("eye", "eye")), here)
        return [where(), call(("y",)), where()]

    assert in_thread(run) == [("arm", "arm"), ("y", ("eye", "eye"), ("eye", "eye")), ("arm", "arm")]


def test_within_changes_back_after_an_error(folders: Path) -> None:
    del folders

    def fail(arguments: tuple[object, ...]) -> None:
        raise ValueError(*arguments)

    def run() -> tuple[str, str]:
        context = thread_context.context_of("arm")
        assert context
        own_folder(context)
        with pytest.raises(ValueError, match="eye"):
            within(fail, "eye", "arm")(("eye",))
        return where()

    assert in_thread(run) == ("arm", "arm")
