"""What all tests share."""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
import tempfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

# How fast the machine is decides nothing, and each run tries the same; `--hypothesis-profile
# random` tries others.
ANYWHERE = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("same", ANYWHERE, derandomize=True)
settings.register_profile("random", ANYWHERE)
settings.load_profile("same")


_M_ARENA_MAX = -8
"""The parameter of glibc's `mallopt` for the number of heaps (malloc.h)."""

_HOMES = ("CONFIG_HOME", "DATA_HOME", "STATE_HOME", "CACHE_HOME")


def pytest_configure(config: pytest.Config) -> None:
    """Give the tests homes of their own, which end with them: nothing of the user is met or left.

    Sockets of each worker are in a folder of its own, so that no two tests share a domain by
    accident; the paths are short, as those of sockets must be. What mypy found out about libraries
    is kept for all runs of a worker.
    """
    _restore_interrupt()
    _share_heaps()
    worker = os.environ.get("PYTEST_XDIST_WORKER", "")
    if not worker:
        home = tempfile.TemporaryDirectory(prefix="rc-", ignore_cleanup_errors=True)
        config.add_cleanup(home.cleanup)
        os.environ |= {f"XDG_{name}": str(Path(home.name) / name.lower()) for name in _HOMES}
        os.environ["XDG_RUNTIME_DIR"] = home.name
    runtime = Path(os.environ["XDG_RUNTIME_DIR"], worker or "alone")
    runtime.mkdir(mode=0o700)
    os.environ["XDG_RUNTIME_DIR"] = str(runtime)
    # No test meets a ROS master of this machine: nobody listens at this port.
    os.environ["ROS_MASTER_URI"] = "http://127.0.0.1:9"
    for variable in ("ROS_IP", "ROS_HOSTNAME"):
        os.environ.pop(variable, None)
    os.environ["MYPY_CACHE_DIR"] = str(Path(os.environ["XDG_CACHE_HOME"], f"mypy-{runtime.name}"))


def _restore_interrupt() -> None:
    """Receive SIGINT, and let child processes receive it, also in the background of a script.

    A shell that is not interactive starts background jobs with SIGINT ignored, children inherit
    that, and a test that interrupts a command would wait until its timeout.
    """
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _share_heaps() -> None:
    """Let all threads share two heaps.

    Tests start thousands of threads, and what a thread has freed stays in its own heap: a worker
    would keep gigabytes that nobody uses. Other C libraries than glibc have no such heaps.
    """
    with contextlib.suppress(AttributeError):
        ctypes.CDLL(None).mallopt(_M_ARENA_MAX, 2)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update-golden",
        action="store_true",
        help="rewrite the expected output that stands beside the cases; read the diff then",
    )


@pytest.fixture
def update_golden(request: pytest.FixtureRequest) -> bool:
    """Whether expected output is to be rewritten instead of compared."""
    return bool(request.config.getoption("--update-golden"))
