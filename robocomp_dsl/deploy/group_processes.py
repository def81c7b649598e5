"""Joins the components of a group with `inprocess` into one process. Pure.

In: the process of each component. Out: the processes to start: `robocomp_dsl.runtime.group_process`
runs the components of a group, each with the arguments of its own `main.py`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from robocomp_dsl.deploy.process import Process
from robocomp_dsl.model.deployment import Deployment, Group

MODULE = "robocomp_dsl.runtime.group_process"
COMPONENT = "group"
"""What stands for the component of such a process."""


def join_groups(
    deployment: Deployment, components: Sequence[Process], interpreter: str
) -> tuple[Process, ...]:
    """One process for each group with `inprocess` and for each other component, in start order."""
    groups = {group.name: group for group in deployment.groups if group.inprocess}
    owners = {
        process.name: groups[instance.process]
        for instance, process in zip(deployment.instances, components, strict=True)
        if instance.process
    }
    if not owners:
        return tuple(components)
    names = {name: group.full_name for name, group in owners.items()}
    joined: dict[str, Process] = {}
    for process in components:
        name = names.get(process.name, process.name)
        if name in joined:
            continue
        if name == process.name:
            joined[name] = process
        else:
            members = tuple(each for each in components if names.get(each.name) == name)
            joined[name] = group_process(owners[process.name], members, interpreter)
    return tuple(_with_group_names(process, names) for process in joined.values())


def group_process(group: Group, members: Sequence[Process], interpreter: str) -> Process:
    """The process of a group."""
    own = [member.name for member in members]
    environment = dict(variable for member in members for variable in member.env)
    ending = next((member.restart for member in members if member.restart.policy == "never"), None)
    return Process(
        name=group.full_name,
        component=COMPONENT,
        argv=command_line(group.full_name, members, interpreter),
        cwd=_common_folder(members),
        env=tuple(environment.items()),
        after=tuple(dict.fromkeys(n for m in members for n in m.after if n not in own)),
        stops_after=tuple(dict.fromkeys(n for m in members for n in m.stops_after if n not in own)),
        restart=ending or group.restart,
        start_timeout_s=group.start_timeout_s,
        limits=group.limits,
        watchdog_s=_watchdog_s(members),
        host=members[0].host,
        placement=members[0].placement,
        group=group.name.rpartition("-")[0],
        members=tuple(
            replace(
                member,
                after=tuple(name for name in member.after if name in own),
                stops_after=tuple(name for name in member.stops_after if name in own),
            )
            for member in members
        ),
    )


def command_line(name: str, members: Iterable[Process], interpreter: str) -> tuple[str, ...]:
    """The command line of a group: its options, then each member with its own arguments."""
    members = tuple(members)
    own = {member.name for member in members}
    argv = [interpreter, "-m", MODULE, "--name", name, "--log-format", "json"]
    for member in members:
        argv += ["--component", str(member.cwd.resolve())]
        after = [other for other in member.after if other in own]
        argv += ["--after", ",".join(after)] if after else []
        argv += component_arguments(member)
    return tuple(argv)


def component_arguments(member: Process) -> list[str]:
    """The arguments of a component's `main.py`; the format of the log is that of the process."""
    arguments = list(member.argv[member.argv.index("--name") :])
    position = arguments.index("--log-format")
    del arguments[position : position + 2]
    return arguments


def _watchdog_s(members: Sequence[Process]) -> float:
    """The time after which the process hangs; 0 if one of its components has no limit."""
    limits = [member.watchdog_s for member in members]
    return max(limits) if all(limits) else 0.0


def _common_folder(members: Sequence[Process]) -> Path:
    """The innermost folder that contains all components."""
    folders = [member.cwd.resolve() for member in members]
    return next(
        folder
        for folder in (folders[0], *folders[0].parents)
        if all(each.is_relative_to(folder) for each in folders)
    )


def _with_group_names(process: Process, names: dict[str, str]) -> Process:
    """The process with the names of groups instead of those of their components."""

    def renamed(others: Iterable[str]) -> Iterator[str]:
        found = dict.fromkeys(names.get(name, name) for name in others)
        return (name for name in found if name != process.name)

    return replace(
        process,
        after=tuple(renamed(process.after)),
        stops_after=tuple(renamed(process.stops_after)),
    )
