"""A constructor of the user's class that raises ends the process: with its line, and no hang."""

from __future__ import annotations

import threading
import uuid

import pytest

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.component.supervision import own_supervision
from robocomp_dsl.runtime.entry_point import create_runner
from robocomp_dsl.runtime.errors import WindowError
from tests.support.waiting import wait_until


class Unplugged(Component):
    """Its constructor raises `failure`."""

    SPEC = ComponentSpec(name="unplugged", period=50)
    failure: BaseException = RuntimeError("no camera")

    def __init__(self) -> None:
        raise self.failure


def threads_that_keep_the_process_alive() -> set[threading.Thread]:
    return {thread for thread in threading.enumerate() if not thread.daemon}


@pytest.mark.parametrize("middleware", ["zenoh", "local"])
@pytest.mark.parametrize(
    ("failure", "message"),
    [
        (RuntimeError("no camera"), "the constructor of Unplugged failed: RuntimeError: no camera"),
        (WindowError("mainUI.ui: not valid"), "mainUI.ui: not valid"),
    ],
)
def test_worker_whose_constructor_raises_ends_the_process(
    middleware: str, failure: Exception, message: str, caplog: pytest.LogCaptureFixture
) -> None:
    before = threads_that_keep_the_process_alive()
    Unplugged.failure = failure
    options = ["--domain", f"test-{uuid.uuid4().hex[:8]}", "--middleware", middleware]
    assert create_runner(Unplugged, options, own_supervision()) is None
    (record,) = caplog.records
    assert record.getMessage().startswith(message)
    assert ("test_worker_constructor.py" in record.getMessage()) is (failure.args[0] == "no camera")
    wait_until(lambda: threads_that_keep_the_process_alive() <= before)


def test_worker_whose_constructor_exits_keeps_its_exit_code() -> None:
    before = threads_that_keep_the_process_alive()
    Unplugged.failure = SystemExit(3)
    with pytest.raises(SystemExit) as raised:
        create_runner(Unplugged, ["--domain", f"test-{uuid.uuid4().hex[:8]}"], own_supervision())
    assert raised.value.code == 3
    wait_until(lambda: threads_that_keep_the_process_alive() <= before)
