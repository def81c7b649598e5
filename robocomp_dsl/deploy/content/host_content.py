"""What one host gets: the trees and environments of its processes.

In: a plan, its trees, the Python of the host. Out: `HostContent`, whose paths need no connection;
then what the host lacks, findings, and the copy.
"""

from __future__ import annotations

import asyncio
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from robocomp_dsl.deploy.content import codes
from robocomp_dsl.deploy.content.host_session import HostSession
from robocomp_dsl.deploy.content.install import find_incomplete, install_environment, wheel_blobs
from robocomp_dsl.deploy.content.lock import Environment, EnvironmentLocker
from robocomp_dsl.deploy.content.transfer import (
    CopyResult,
    HostState,
    Progress,
    find_lacking,
    upload_trees,
)
from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.content.wheel_target import WheelTarget
from robocomp_dsl.deploy.content.wheelhouse import Wheelhouse, WheelStore
from robocomp_dsl.deploy.hosts.connection import HostConnection
from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Span

SPARE_BYTES = 50_000_000
"""Space that stays free after a copy."""


@dataclass(frozen=True)
class HostContent:
    """The content of one host: `trees` and `environments` by full name of the process.

    `environments` has no program that is not Python. `runtime` is for programs of robocomp_dsl
    itself, such as the router and the helpers of units. `root` is the deployment's folder, relative
    to the home.
    """

    root: str
    target: WheelTarget
    trees: Mapping[str, ContentTree]
    environments: Mapping[str, Environment]
    runtime: Environment

    @cached_property
    def all_environments(self) -> tuple[Environment, ...]:
        """The environments, each once."""
        distinct = {e.hash: e for e in (self.runtime, *self.environments.values())}
        return tuple(distinct.values())

    def environment_of(self, process: str) -> Environment:
        """The environment of a process; the runtime's for a program that is not Python."""
        return self.environments.get(process, self.runtime)

    def python_of(self, process: str) -> str:
        """The interpreter of a process, relative to the home."""
        return python_path(self.root, self.environment_of(process))


def python_path(root: str, environment: Environment) -> str:
    """The interpreter of an environment, relative to the home."""
    return f"{root}/environments/{environment.hash}/bin/python"


def describe_content(
    root: str,
    target: WheelTarget,
    processes: Sequence[Process],
    trees: Mapping[str, ContentTree],
    locker: EnvironmentLocker,
    span: Span,
) -> HostContent:
    """The content of a host that runs `processes`; `span` is the place of the host in the file."""
    locked = {process.name: locker.lock(process, trees[process.name]) for process in processes}
    return HostContent(
        root,
        target,
        {process.name: trees[process.name] for process in processes},
        {name: environment for name, environment in locked.items() if environment},
        locker.lock_runtime(span),
    )


@dataclass(frozen=True, slots=True)
class ContentCheck:
    """What a host lacks: its `state`, and by hash the wheels of environments to install.

    `damaged` are environments that are there but not complete, with the reason.
    """

    content: HostContent
    state: HostState
    wheelhouses: Mapping[str, Wheelhouse]
    damaged: Mapping[str, str]

    @property
    def is_complete(self) -> bool:
        """Whether nothing is copied."""
        return not (self.state.trees or self.wheelhouses)


async def check_content(
    connection: HostConnection, content: HostContent, span: Span, report: Report
) -> ContentCheck:
    """Ask the host what it lacks and get the wheels for it. Raises `HostError`.

    Wheels that cannot be had and a lack of space are findings at `span`, the place of the host.
    Nothing is copied.
    """
    store = WheelStore()
    trees = list(content.trees.values())
    wheelhouses: dict[str, Wheelhouse] = {}
    async with HostSession(connection, content.root, content.target.path) as session:
        incomplete = await find_incomplete(session, content.all_environments)
        for environment in content.all_environments:
            if environment.hash not in incomplete:
                continue
            found, problems = await asyncio.to_thread(store.collect, environment, content.target)
            if found:
                wheelhouses[environment.hash] = found
            for problem in problems:
                report.add(codes.DISTRIBUTION, span, problem.message, help=problem.help)
        wheels = [blob for house in wheelhouses.values() for blob in wheel_blobs(house)]
        state = await find_lacking(session, trees, wheels)
    check = ContentCheck(content, state, wheelhouses, _damaged(incomplete))
    _check_space(connection, check, span, report)
    return check


async def copy_content(
    connection: HostConnection, check: ContentCheck, progress: Progress | None = None
) -> CopyResult:
    """Copy and install what the host lacks. Raises `HostError`."""
    content = check.content
    result = CopyResult()
    if check.state.trees:
        trees = list(content.trees.values())
        python = content.target.path
        result += await upload_trees(
            connection, content.root, trees, python=python, progress=progress
        )
    for environment in content.all_environments:
        if wheelhouse := check.wheelhouses.get(environment.hash):
            result += await install_environment(
                connection, content.root, environment, content.target, wheelhouse, progress=progress
            )
    return result


def _damaged(incomplete: Mapping[str, str]) -> dict[str, str]:
    return {name: reason for name, reason in incomplete.items() if reason != "missing"}


def _check_space(
    connection: HostConnection, check: ContentCheck, span: Span, report: Report
) -> None:
    missing = (t for t in check.content.trees.values() if t.hash in check.state.trees)
    trees = sum({tree.hash: tree.size for tree in missing}.values())
    installed = sum(house.installed_bytes for house in check.wheelhouses.values())
    needed = check.state.missing_bytes + trees + installed
    if not needed or needed + SPARE_BYTES <= check.state.free_bytes:
        return
    free = check.state.free_bytes / 1e6
    message = f"not enough space: {needed / 1e6:.0f} MB are needed, {free:.0f} MB are free"
    parts = f"{check.state.missing_bytes / 1e6:.0f} MB to copy, {trees / 1e6:.0f} MB of components"
    name = connection.host.name or "localhost"
    report.add(
        codes.SPACE,
        span,
        f"`{name}`: {message}",
        label=f"{parts}, {installed / 1e6:.0f} MB of Python packages",
        help=f"free space in ~/{check.content.root} or elsewhere on that file system",
    )
