"""Describes the trees of a deployment: which files each component needs on its host.

In: a deployment and its plan. Out: a `ContentTree` per process, and findings at the instances.
Reads files, writes only the cache of hashes. The result is deterministic.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from robocomp_dsl.deploy.content import codes
from robocomp_dsl.deploy.content.folder_scan import (
    FolderScan,
    ScanProblem,
    check_file,
    scan_folder,
)
from robocomp_dsl.deploy.content.hash_cache import HashCache
from robocomp_dsl.deploy.content.named_files import NamedFile, named_files, place_of
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


def describe_trees(
    deployment: Deployment,
    plan: Plan,
    report: Report,
    files: Mapping[str, Sequence[Path]] | None = None,
    hashes: HashCache | None = None,
) -> dict[str, ContentTree]:
    """The tree of each process, by its full name.

    `files` are further files and folders by full name, relative paths to the component's folder.
    """
    describer = TreeDescriber(deployment, hashes or HashCache())
    trees = {}
    for instance, process in zip(deployment.instances, plan.processes, strict=True):
        extra = (files or {}).get(process.name, ())
        trees[process.name] = describer.describe(instance, process, extra, report)
    describer.hashes.save()
    return trees


class TreeDescriber:
    """Describes trees; a folder that several instances use is read once."""

    def __init__(self, deployment: Deployment, hashes: HashCache) -> None:
        self.hashes = hashes
        self._deployment = deployment
        self._scans: dict[str, FolderScan] = {}
        self._hashed: dict[str, str | ScanProblem] = {}

    def describe(
        self, instance: Instance, process: Process, extra: Sequence[Path], report: Report
    ) -> ContentTree:
        """The tree of one process; files that cannot be copied are findings."""
        folder = process.cwd.resolve()
        searched = None if process.config else _search_config(instance, process)
        named = named_files(
            instance,
            process,
            self._deployment.connections,
            self._deployment.path,
            extra,
            process.config or searched,
        )
        anchors = [folder.parent, *named.folders, *(file.path.parent for file in named.files)]
        origin = os.path.commonpath(anchors)
        problems: list[ScanProblem] = []
        found = list(self._component_files(instance, str(folder), problems))
        for file in named.files:
            found += self._named(file, problems)
        entries = list(self._hash_all(found, origin, problems))
        tree = make_tree(
            Path(origin),
            os.path.relpath(folder, origin),
            entries,
            [os.path.relpath(path, origin) for path in named.folders],
            _names(named.files, origin, folder),
            os.path.relpath(place_of(searched), origin) if searched else "",
        )
        _report_problems(instance, problems, report)
        _report_size(instance, tree, report)
        return tree

    def _component_files(
        self, instance: Instance, folder: str, problems: list[ScanProblem]
    ) -> Sequence[Status]:
        """The component's folder; a program is only the files that it names."""
        if instance.is_program:
            return ()
        return self._scan(folder, problems)

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


def _names(files: Sequence[NamedFile], origin: str, folder: Path) -> Iterator[tuple[str, str]]:
    """The paths of the command line and their places, longest first."""
    paths = {file.text: file.path for file in files if file.text} | {str(folder): folder}
    for text in sorted(paths, key=len, reverse=True):
        if Path(text).is_absolute():
            yield text, os.path.relpath(paths[text], origin)


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
