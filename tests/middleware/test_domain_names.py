"""A name belongs to one running component of a domain, and to one deployment."""

from __future__ import annotations

import os
import re
import signal
import socket
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.presence.domain_folder import domain_path
from robocomp_dsl.runtime.presence.domain_names import (
    NameTaken,
    reserve,
    running_components,
)
from robocomp_dsl.runtime.presence.domain_session import DomainSession, open_session
from tests.middleware.domain_process import domain_process
from tests.middleware.network import Network
from tests.support.waiting import wait_until

STARTED = r"started \d{4}-\d\d-\d\d \d\d:\d\d:\d\d"


@pytest.fixture
def domain() -> str:
    return Network("zenoh").domain


def closed(session: DomainSession) -> bool:
    session.close()
    return True


def test_second_component_of_a_name_is_refused_with_pid_and_start_time(domain: str) -> None:
    with domain_process(domain, "left/arm") as first:
        message = re.escape(f"`left/arm` is already running in the domain `{domain}`")
        with pytest.raises(MiddlewareError, match=rf"{message} \(pid {first.pid}, {STARTED}\)"):
            open_session(domain, name="left/arm")
        assert closed(open_session(domain, name="right/arm"))
        assert closed(open_session(domain)), "clients need no name"
        assert closed(open_session(f"{domain}-2", name="left/arm")), "another domain"
        (holder,) = running_components(domain, ["left/arm", "right/arm"])
        assert holder.pid == first.pid


@pytest.mark.parametrize("mode", ["", "fork"])
def test_name_of_a_killed_component_is_free_at_once(domain: str, mode: str) -> None:
    """Also if a child that it has forked lives on."""
    with domain_process(domain, "arm", mode) as first:
        first.send_signal(signal.SIGKILL)
        first.wait()
        assert closed(open_session(domain, name="arm"))
    assert not domain_path(domain).exists()


def test_name_of_a_stopped_process_stays_taken(domain: str) -> None:
    with domain_process(domain, "arm") as first:
        first.send_signal(signal.SIGSTOP)
        with pytest.raises(MiddlewareError, match=f"pid {first.pid}"):
            open_session(domain, name="arm")


def test_name_is_free_after_a_clean_end(domain: str) -> None:
    for _ in range(3):
        assert closed(open_session(domain, name="arm"))
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        with pytest.raises(MiddlewareError, match=r"port [0-9]+ cannot be used"):
            open_session(domain, port=taken.getsockname()[1], name="arm")
    assert closed(open_session(domain, name="arm")), "a failed start releases the name"
    assert not domain_path(domain).exists()


@pytest.mark.parametrize("name", ["a.b", "x" * 100, "/".join(["y" * 100] * 9), "lock", "ü/é"])
def test_claim_component_takes_any_name(domain: str, name: str) -> None:
    first = open_session(domain, name=name)
    with pytest.raises(MiddlewareError, match=f"pid {os.getpid()}"):
        open_session(domain, name=name)
    first.close()
    assert closed(open_session(domain, name=name))


@pytest.mark.parametrize("content", [b"", b"{", b"[1]", b'{"pid": 7}', b"\xff\xfe"])
def test_name_taken_reports_unreadable_lock_files(domain: str, content: bytes) -> None:
    first = open_session(domain, name="arm")
    assert first.name is not None
    first.name.path.write_bytes(content)
    with pytest.raises(MiddlewareError, match=r"`arm` is already running in the domain `[^`]*`;"):
        open_session(domain, name="arm")
    first.close()


def test_reserve_refuses_names_of_another_deployment_and_takes_none(domain: str) -> None:
    first = reserve(domain, ["arm", "base"], "robot")
    with pytest.raises(
        NameTaken, match=rf"`base` .* by the deployment `robot` \(pid {os.getpid()}"
    ):
        reserve(domain, ["again", "base", "camera"], "other")
    reserve(domain, ["again", "camera"], "other").release()
    # Its own components start, and so does a component of that name that is started by hand.
    assert closed(open_session(domain, name="arm"))
    first.release()
    reserve(domain, ["arm", "base"], "other").release()
    assert not domain_path(domain).exists()


def test_reserve_refuses_names_of_running_components(domain: str) -> None:
    with (
        domain_process(domain, "arm") as first,
        pytest.raises(NameTaken, match=rf"`arm` is already running .*\(pid {first.pid}, {STARTED}"),
    ):
        reserve(domain, ["arm", "base"], "robot")
    reserve(domain, ["arm", "base"], "robot").release()


def test_reserve_of_two_deployments_at_once_lets_one_succeed(domain: str) -> None:
    def attempt(deployment: str) -> Callable[[], None] | None:
        try:
            return reserve(domain, ["a", "b", "c", deployment], deployment).release
        except NameTaken:
            return None

    with ThreadPoolExecutor(4) as pool:
        for turn in range(3):
            releases = list(pool.map(attempt, [f"{turn}-{n}" for n in range(4)]))
            (release,) = filter(None, releases)
            release()


def test_domain_folder_is_deleted_after_all_were_killed(domain: str) -> None:
    with domain_process(domain, "arm"), domain_process(domain, "base"):
        folder = domain_path(domain)
        assert len(list(folder.glob("*.component"))) == 2
    wait_until(lambda: not running_components(domain, ["arm", "base"]))
    assert closed(open_session(domain))
    assert not Path(folder).exists()
