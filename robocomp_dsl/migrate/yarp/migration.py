"""Plans the migration of files of YARP.

In: files of yarpmanager and yarprobotinterface. Out: a `YarpPlan`: files as data, names of
deployments and of worlds from which simulators are generated, and findings.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.migrate.yarp import codes, host_list
from robocomp_dsl.migrate.yarp.application import Application, read_application
from robocomp_dsl.migrate.yarp.application_ddsl import application_text
from robocomp_dsl.migrate.yarp.document import APPLICATION, OTHER_ROOTS, ROBOT_ROOTS, root_name
from robocomp_dsl.migrate.yarp.host_list import ListedMachine
from robocomp_dsl.migrate.yarp.programs import UniqueNames, draft_application
from robocomp_dsl.migrate.yarp.robot import migrate_robot
from robocomp_dsl.migrate.yarp.robot_files import read_robot
from robocomp_dsl.source import Source, UnreadableSource

MAX_SEARCHED = 500
"""Files of a folder in which nested applications are searched."""


@dataclass(slots=True)
class YarpPlan:
    """`converted_files` are pairs of old and new path; `worlds` are paths of generated worlds."""

    files: list[OutputFile] = field(default_factory=list)
    converted_files: list[tuple[str, str]] = field(default_factory=list)
    deployments: list[str] = field(default_factory=list)
    worlds: list[str] = field(default_factory=list)


def is_yarp_file(path: Path) -> bool:
    """Whether a file is one of YARP, by its root element."""
    if path.suffix.lower() == ".toml":
        return False
    try:
        return root_name(Source.read(path)) in (APPLICATION, *ROBOT_ROOTS, *OTHER_ROOTS)
    except UnreadableSource:
        return False


def plan_yarp_files(
    paths: Sequence[Path],
    out: Path,
    report: Report,
    *,
    tags: Sequence[str] = (),
    taken: Sequence[str] = (),
) -> YarpPlan:
    """Plan the migration of files for which `is_yarp_file` holds.

    `out` is the output folder; `tags` enable parts of robots; `taken` are names in use.
    """
    plan, names = YarpPlan(), UniqueNames()
    for name in taken:
        names.claim(name)
    applications: dict[str, Application] = {}
    own: list[tuple[Path, Application]] = []
    lists: list[Source] = []
    for path in paths:
        source = Source.read(path)
        root = root_name(source)
        if root == APPLICATION:
            if application := read_application(source, report):
                own.append((path, application))
                applications.setdefault(_key(application), application)
        elif root in host_list.ROOTS:
            lists.append(source)
        elif root in ROBOT_ROOTS:
            _add_robot(source, out, frozenset(tags), names, plan, report)
        else:
            message = f"`<{root}>`: name the application or the robot that uses this file"
            report.add(codes.UNSUPPORTED_FORMAT, source.file_span, message)
    machines = _machines(lists, report, used=bool(own))
    if any(application.nested for _, application in own):
        _add_neighbours(paths, applications)
    nested = _nested_names(own, applications)
    for path, application in own:
        if _key(application) not in nested:
            _add_application(path, application, applications, machines, names, plan, report)
    return plan


def _machines(lists: Sequence[Source], report: Report, *, used: bool) -> list[ListedMachine]:
    """The machines of all lists; reports lists that no application uses."""
    machines: list[ListedMachine] = []
    for source in lists:
        if used:
            machines += host_list.read_host_list(source, report)
        else:
            message = f"`<{root_name(source)}>`: name the application that uses these machines, too"
            report.add(codes.UNSUPPORTED_FORMAT, source.file_span, message)
    return machines


def _key(application: Application) -> str:
    """The name by which other applications include it; yarpmanager replaces spaces."""
    return application.name.replace(" ", "_")


def _nested_names(
    own: Sequence[tuple[Path, Application]], applications: dict[str, Application]
) -> set[str]:
    """The applications that others include; if they all include each other, none."""
    names: set[str] = set()
    for _, application in own:
        pending = [application]
        seen = {_key(application)}
        while pending:
            for nested in pending.pop().nested:
                key = nested.name.replace(" ", "_")
                if key not in seen and key in applications:
                    seen.add(key)
                    pending.append(applications[key])
        names |= seen - {_key(application)}
    return names if any(_key(application) not in names for _, application in own) else set()


def _add_neighbours(paths: Sequence[Path], applications: dict[str, Application]) -> None:
    """Add the applications in the folders of `paths`; their findings are for their own run."""
    for folder in dict.fromkeys(path.parent for path in paths):
        for path in sorted(folder.glob("*.xml*"))[:MAX_SEARCHED]:
            if path in paths or not path.is_file():
                continue
            try:
                source = Source.read(path)
            except UnreadableSource:
                continue
            if root_name(source) == APPLICATION:
                application = read_application(source, Report())
                if application is not None:
                    applications.setdefault(_key(application), application)


def _deployment_name(path: Path, names: UniqueNames) -> str:
    return names.claim(re.sub(r"\W", "_", path.name.partition(".")[0], flags=re.ASCII))


def _add_application(
    path: Path,
    application: Application,
    applications: dict[str, Application],
    machines: Sequence[ListedMachine],
    names: UniqueNames,
    plan: YarpPlan,
    report: Report,
) -> None:
    name = _deployment_name(path, names)
    draft = draft_application(application, applications, report, machines)
    plan.files.append(OutputFile(f"{name}.ddsl", application_text(name, draft)))
    plan.deployments.append(f"{name}.ddsl")
    plan.converted_files.append((path.name, f"{name}.ddsl"))


def _add_robot(
    source: Source,
    out: Path,
    tags: frozenset[str],
    names: UniqueNames,
    plan: YarpPlan,
    report: Report,
) -> None:
    robot = read_robot(source, report, tags)
    if robot is None:
        return
    name = _deployment_name(source.path, names)
    file = os.path.relpath(source.path, out)
    migrated = migrate_robot(robot, name, file, report)
    plan.files.append(OutputFile(f"{name}.ddsl", migrated.deployment))
    plan.deployments.append(f"{name}.ddsl")
    plan.converted_files.append((source.path.name, f"{name}.ddsl"))
    if migrated.world:
        plan.files.append(OutputFile(f"{name}.xml", migrated.world))
        plan.worlds.append(f"{name}.xml")
        plan.converted_files += [(each.name, f"{name}.xml") for each in robot.files[1:]]
