"""Describes the trees of a deployment: which files each component needs on its host.

In: a deployment and its plan. Out: a `ContentTree` per process, and findings at the instances.
Reads files, writes only the cache of hashes. The result is deterministic.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.deploy.content import codes
from robocomp_dsl.deploy.content.folder_scan import (
    FolderScan,
    ScanProblem,
    check_file,
    scan_folder,
)
from robocomp_dsl.deploy.content.hash_cache import HashCache
from robocomp_dsl.deploy.content.named_files import NamedFile, NamedFileFinder, NamedFiles, place_of
from robocomp_dsl.deploy.content.tree import ContentTree, TreeFile, make_tree
from robocomp_dsl.deploy.plan import Plan, Process
from robocomp_dsl.deploy.preflight import search_config, short_path
from robocomp_dsl.diagnostics import Code, Diagnostic, Report
from robocomp_dsl.model.deployment import Deployment, Instance
from robocomp_dsl.runtime.parameters import ConfigError

MAX_TREE_BYTES = 4 << 30
LARGE_TREE_BYTES = 200_000_000
_EXECUTABLE = stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH
_LISTED_PROBLEMS = 5

Status = tuple[str, os.stat_result]


@dataclass(frozen=True, slots=True)
class _Member:
    """One component of a process, what it names, and the configuration found in its context."""

    instance: Instance
    process: Process
    folder: Path
    named: NamedFiles
    searched: Path | None

    def anchors(self) -> Iterator[Path]:
        """Folders that are in the tree."""
        yield self.folder.parent
        yield from self.named.folders
        for file in self.named.files:
            yield file.path.parent

    def paths(self) -> Iterator[tuple[str, Path]]:
        """The paths in its command line, and what they lead to."""
        yield str(self.folder), self.folder
        yield from ((file.text, file.path) for file in self.named.files if file.text)


def describe_trees(
    deployment: Deployment,
    plan: Plan,
    report: Report,
    hashes: HashCache | None = None,
) -> dict[str, ContentTree]:
    """The tree of each process, by its full name; a group in one process has one tree."""
    describer = TreeDescriber(deployment, plan, hashes or HashCache())
    trees = {process.name: describer.describe(process, report) for process in plan.processes}
    describer.hashes.save()
    return trees


class TreeDescriber:
    """Describes trees; a folder that several instances use is read once."""

    def __init__(self, deployment: Deployment, plan: Plan, hashes: HashCache) -> None:
        self.hashes = hashes
        self._finder = NamedFileFinder(deployment.path, deployment.connections)
        names = (process.name for process in plan.components)
        self._instances = dict(zip(names, deployment.instances, strict=True))
        self._scans: dict[str, FolderScan] = {}
        self._trees: dict[object, ContentTree] = {}
        self._hashed: dict[str, str | ScanProblem] = {}

    def describe(self, process: Process, report: Report) -> ContentTree:
        """The tree of one process; files that cannot be copied are findings."""
        members = [self._member(member) for member in process.members or (process,)]
        key = tuple((member.folder, member.named, member.searched) for member in members)
        if key in self._trees and not any(member.searched for member in members):
            return self._trees[key]
        before = len(report)
        tree = self._tree(self._finder.resolve(process.cwd), members, report)
        _report_size(members[0].instance, tree, report)
        if len(report) == before:
            self._trees[key] = tree
        return tree

    def _tree(self, folder: Path, members: Sequence[_Member], report: Report) -> ContentTree:
        anchors = [folder] if len(members) > 1 else [folder.parent]
        anchors += [path for member in members for path in member.anchors()]
        origin = os.path.commonpath(anchors)
        entries: list[TreeFile] = []
        for member in members:
            problems: list[ScanProblem] = []
            found = list(self._component_files(member, problems))
            for file in member.named.files:
                found += self._named(file, problems)
            entries += self._hash_all(found, origin, problems)
            _report_problems(member.instance, problems, report)
        return make_tree(
            Path(origin),
            os.path.relpath(folder, origin),
            entries,
            [os.path.relpath(path, origin) for member in members for path in member.named.folders],
            _names([path for member in members for path in member.paths()], origin),
            [
                (member.process.name, os.path.relpath(place_of(member.searched), origin))
                for member in members
                if member.searched
            ],
        )

    def _member(self, process: Process) -> _Member:
        instance = self._instances[process.name]
        searched = None if process.config else _search_config(instance, process)
        folder = self._finder.resolve(process.cwd)
        named = self._finder.find(instance, folder, process.config or searched)
        return _Member(instance, process, folder, named, searched)

    def _component_files(self, member: _Member, problems: list[ScanProblem]) -> Sequence[Status]:
        """The component's folder; a program is only the files that it names."""
        return () if member.instance.is_program else self._scan(str(member.folder), problems)

    def _scan(self, folder: str, problems: list[ScanProblem]) -> Sequence[Status]:
        scan = self._scans.get(folder)
        if scan is None:
            scan = self._scans[folder] = scan_folder(Path(folder))
        problems.extend(scan.problems)
        return scan.files

    def _named(self, file: NamedFile, problems: list[ScanProblem]) -> Iterator[Status]:
        try:
            status = file.path.stat()
        except OSError as error:
            if file.required:
                problems.append(ScanProblem(file.path, error.strerror or str(error)))
            return
        if stat.S_ISDIR(status.st_mode):
            yield from self._scan(str(file.path), problems)
        elif not stat.S_ISREG(status.st_mode):
            if file.required:
                problems.append(ScanProblem(file.path, "is not a regular file"))
        elif problem := check_file(str(file.path), status):
            problems.append(problem)
        else:
            yield str(file.path), status

    def _hash_all(
        self, found: Sequence[Status], origin: str, problems: list[ScanProblem]
    ) -> Iterator[TreeFile]:
        start = len(origin.rstrip("/")) + 1
        for path, status in found:
            digest = self._hashed.get(path)
            if digest is None:
                digest = self._hashed[path] = self._hash(path, status)
            if isinstance(digest, ScanProblem):
                problems.append(digest)
                continue
            executable = bool(status.st_mode & _EXECUTABLE)
            yield TreeFile(path[start:], digest, status.st_size, executable, path)

    def _hash(self, path: str, status: os.stat_result) -> str | ScanProblem:
        try:
            return self.hashes.sha256(path, status)
        except OSError as error:
            reason = error.strerror or str(error)
            return ScanProblem(
                Path(path), f"cannot be read: {reason}", f"chmod u+r {path}, or move it away"
            )


def _search_config(instance: Instance, process: Process) -> Path | None:
    """The configuration in the context of an instance; a failed search is preflight's finding."""
    try:
        return search_config(instance.name, process)
    except ConfigError:
        return None


def _names(paths: Sequence[tuple[str, Path]], origin: str) -> Iterator[tuple[str, str]]:
    """The paths of the command line and their places, longest first."""
    distinct = dict(paths)
    for text in sorted(distinct, key=len, reverse=True):
        if Path(text).is_absolute():
            yield text, os.path.relpath(distinct[text], origin)


def _report_problems(instance: Instance, problems: list[ScanProblem], report: Report) -> None:
    distinct = list(dict.fromkeys(problems))
    for problem in distinct[:_LISTED_PROBLEMS]:
        message = f"`{instance.name}`: {short_path(problem.path.parent)}/{problem.path.name}"
        _add(report, instance, codes.FILE, f"{message} {problem.message}", problem.help)
    if (more := len(distinct) - _LISTED_PROBLEMS) > 0:
        message = f"`{instance.name}`: {more} more files cannot be copied"
        _add(report, instance, codes.FILE, message, "")


def _report_size(instance: Instance, tree: ContentTree, report: Report) -> None:
    size = f"{tree.size / 1e6:.0f} MB in {len(tree.files)} files"
    if tree.size > MAX_TREE_BYTES:
        message = f"`{instance.name}`: its files are too large for a copy: {size}"
        largest = max(tree.files, key=lambda file: file.size)
        help_text = f"the largest is {largest.path}, {largest.size / 1e6:.0f} MB"
        _add(report, instance, codes.FILE, message, help_text)
    elif tree.size > LARGE_TREE_BYTES:
        message = f"`{instance.name}`: {size} are copied to its host"
        largest = max(tree.files, key=lambda file: file.size)
        help_text = f"the largest is {largest.path}, {largest.size / 1e6:.0f} MB"
        _add(report, instance, codes.LARGE, message, help_text)


def _add(report: Report, instance: Instance, code: Code, message: str, help: str) -> None:
    report.extend([Diagnostic(code, instance.span, message, help=help)])
