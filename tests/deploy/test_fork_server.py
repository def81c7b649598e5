"""The fork server: its processes are as executed ones, and what it cannot do is executed."""

from __future__ import annotations

import asyncio
import os
import sys
from collections.abc import Callable, Coroutine
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.supervisor.fork_server import (
    ForkedProcess,
    ForkServer,
    is_forkable,
    shadowed_modules,
)
from robocomp_dsl.deploy.supervisor.process_start import StartedProcess
from robocomp_dsl.model.deployment import ResourceLimits

TOKEN = {"ROBOCOMP_DEPLOYMENT": "test.1"}
Steps = Callable[[ForkServer], Coroutine[Any, Any, None]]


def program(folder: Path, text: str, name: str = "main.py") -> Process:
    (folder / name).write_text(text)
    return Process("a", "a", (sys.executable, name, "--flag", "x y"), folder)


def with_server(steps: Steps) -> None:
    async def run() -> None:
        server = ForkServer(TOKEN, lambda *_: None)
        try:
            await asyncio.wait_for(steps(server), 60)
        finally:
            server.close()

    asyncio.run(run())


async def start(server: ForkServer, process: Process, **variables: str) -> StartedProcess:
    read_end, write_end = os.pipe()
    try:
        return await server.start(process, {**os.environ, **variables, **TOKEN}, write_end)
    finally:
        os.close(read_end)
        os.close(write_end)


async def output(started: StartedProcess) -> tuple[str, str, int]:
    """What it printed, its errors, and its exit code."""
    out = await asyncio.to_thread(started.stdout.read)
    errors = await asyncio.to_thread(started.stderr.read)
    started.stdout.close()
    started.stderr.close()
    return out.decode(), errors.decode(), await started.exit_code()


def test_fork_server_runs_program_as_main(tmp_path: Path) -> None:
    text = """
import json, os, signal, sys
from pathlib import Path
print(json.dumps([
    __name__, sys.argv, sys.orig_argv[1:], sys.path[0], os.getcwd(), os.environ["COLOUR"],
    Path("/proc/self/cmdline").read_text().split("\\0")[1:-1],
    "COLOUR=red" in Path("/proc/self/environ").read_text(),
    os.getsid(0) == os.getpid(), signal.getsignal(signal.SIGINT) is signal.default_int_handler,
    "ROBOCOMP_HEARTBEAT_FD" in os.environ, __file__, sys.stdin.read(),
]))
sys.exit(7)
"""

    async def steps(server: ForkServer) -> None:
        started = await start(server, program(tmp_path, text), COLOUR="red")
        assert isinstance(started, ForkedProcess)
        out, errors, code = await output(started)
        assert (errors, code) == ("", 7)
        words, folder = ["main.py", "--flag", "x y"], str(tmp_path)
        assert out.strip() == (
            str([
                "__main__", words, words, folder, folder, "red", words,
                True, True, True, True, f"{folder}/main.py", "",
            ]).replace("'", '"').replace("True", "true")
        )  # fmt: skip

    with_server(steps)


def test_fork_server_shows_traceback_without_own_frames(tmp_path: Path) -> None:
    async def steps(server: ForkServer) -> None:
        _, errors, code = await output(await start(server, program(tmp_path, "x = 1\n1 / 0\n")))
        assert code == 1
        assert errors.splitlines()[:2] == [
            "Traceback (most recent call last):",
            f'  File "{tmp_path}/main.py", line 2, in <module>',
        ]
        assert "forked_program" not in errors

    with_server(steps)


def test_forked_processes_have_different_random_numbers(tmp_path: Path) -> None:
    text = "import random, numpy.random as n; print(random.random(), n.random())"

    async def steps(server: ForkServer) -> None:
        process = program(tmp_path, text)
        first, second = [(await output(await start(server, process)))[0] for _ in range(2)]
        assert not set(first.split()) & set(second.split())

    with_server(steps)


def test_fork_server_reports_missing_folder(tmp_path: Path) -> None:
    async def steps(server: ForkServer) -> None:
        process = program(tmp_path, "")
        (tmp_path / "other").mkdir()
        with pytest.raises(FileNotFoundError):
            await server._fork(replace(process, cwd=tmp_path / "none"), dict(os.environ), 2)

    with_server(steps)


def test_ended_fork_server_leaves_executing(tmp_path: Path) -> None:
    async def steps(server: ForkServer) -> None:
        await start(server, program(tmp_path, ""))
        os.kill(server.pid, 9)
        while server._is_alive:
            await asyncio.sleep(0.01)
        started = await start(server, program(tmp_path, "print('executed')"))
        assert not isinstance(started, ForkedProcess)
        assert (await output(started))[0] == "executed\n"

    with_server(steps)


def test_is_forkable_only_for_plain_components(tmp_path: Path) -> None:
    plain = program(tmp_path, "")
    assert is_forkable(plain)
    others = (
        replace(plain, argv=("/bin/true", "main.py")),
        replace(plain, argv=(sys.executable, "-m", "main")),
        replace(plain, argv=(sys.executable, "missing.py")),
        replace(plain, is_program=True),
        replace(plain, env=(("LD_PRELOAD", "x.so"),)),
        replace(plain, env=(("PYTHONOPTIMIZE", "1"),)),
        replace(plain, limits=ResourceLimits(cores=(0,))),
    )
    assert not any(map(is_forkable, others))
    assert is_forkable(replace(plain, env=(("MODE", "fast"),)))


def test_shadowed_modules_are_found(tmp_path: Path) -> None:
    process = program(tmp_path, "")
    assert not shadowed_modules(process, {"numpy", "__main__"})
    (tmp_path / "numpy.py").touch()
    assert shadowed_modules(process, {"numpy", "yaml"}) == {"numpy"}
