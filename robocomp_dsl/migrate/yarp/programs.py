"""Programs and connections of an application and of those nested in it, with their prefixes.

In: applications by name. Out: an `ApplicationDraft`, and findings.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.yarp import codes
from robocomp_dsl.migrate.yarp.application import (
    Application,
    ConnectionEntry,
    ModuleEntry,
    NestedApplication,
)
from robocomp_dsl.migrate.yarp.host_list import ListedMachine
from robocomp_dsl.source import Span

START_WAIT_S = 0.1
"""yarpmanager starts all modules at once: a program is ready as soon as it runs."""
PORT_TIMEOUT_S = 10.0
"""Of a dependency on a port that states none; so long yarpmanager waits for a start."""
LOCAL_NODES = ("", "localhost", "127.0.0.1")
_WORD = re.compile(r'(?:[^\s"]|"[^"]*"?)+')
_WAIT = "python3 -m robocomp_dsl.runtime.middleware.yarp.run_when"
_HOST = re.compile(r"[A-Za-z0-9](?:[A-Za-z0-9_.-]*[A-Za-z0-9])?")
_VARIABLE_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)


@dataclass(frozen=True, slots=True)
class ProgramDraft:
    """A program of the deployment; `node` "": this machine. `by_load`: on any of the hosts."""

    name: str
    command: str
    node: str
    environment: tuple[tuple[str, str], ...]
    ready_s: float
    by_load: bool = False


@dataclass(frozen=True, slots=True)
class HostDraft:
    """A host of the deployment; `address` "": this machine; `user` "": that of ssh."""

    name: str
    address: str
    user: str = ""


@dataclass(frozen=True, slots=True)
class ConnectionDraft:
    """A connection between ports; `carrier` "": the default."""

    source: str
    target: str
    carrier: str


@dataclass(slots=True)
class ApplicationDraft:
    """What becomes a deployment. `hosts` are by their name in the files of YARP."""

    application: Application
    programs: list[ProgramDraft] = field(default_factory=list)
    connections: list[ConnectionDraft] = field(default_factory=list)
    hosts: dict[str, HostDraft] = field(default_factory=dict)


class UniqueNames:
    """Names of a deployment, each once: `yarpview`, `yarpview_2`."""

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def claim(self, requested: str) -> str:
        """A free name based on `requested`."""
        name = re.sub(r"\W", "_", requested, flags=re.ASCII).strip("_") or "program"
        name = f"_{name}" if name[0].isdigit() else name
        number, free = 1, name
        while free.lower() in self._taken:
            number += 1
            free = f"{name}_{number}"
        self._taken.add(free.lower())
        return free


def draft_application(
    application: Application,
    others: Mapping[str, Application],
    report: Report,
    machines: Sequence[ListedMachine] = (),
) -> ApplicationDraft:
    """The programs and connections of `application`; nested ones are found in `others`.

    With a list of `machines` modules without a `<node>` are placed by load, as yarpmanager does.
    """
    draft = ApplicationDraft(application)
    _Drafter(draft, others, report, machines).add(application, "", (application.name,))
    return draft


class _Drafter:
    """Adds an application and its nested ones to a draft."""

    def __init__(
        self,
        draft: ApplicationDraft,
        others: Mapping[str, Application],
        report: Report,
        machines: Sequence[ListedMachine],
    ) -> None:
        self._draft = draft
        self._machines = {machine.name: machine for machine in machines}
        self._others = others
        self._report = report
        self._names = UniqueNames()
        self._hosts = UniqueNames()
        self._connected: set[tuple[str, str]] = set()

    def add(self, application: Application, prefix: str, path: tuple[str, ...]) -> None:
        """Add `application` below `prefix`; `path` are the names of the enclosing ones."""
        for module in application.modules:
            self._add_program(module, prefix)
        external = {dependency.port for dependency in application.ports}
        for connection in application.connections:
            self._add_connection(connection, prefix, external)
        for port, span in application.arbitrators:
            message = f"the arbitrator of `{port or 'no port'}` was not migrated"
            self._report.add(codes.ARBITRATOR, span, message)
        for dependency in application.ports:
            message = f"the connections wait for `{dependency.port}` by themselves"
            self._report.add(codes.SETTING_NOT_NEEDED, dependency.span, message)
        for nested in application.nested:
            self._add_nested(nested, prefix, path)

    def _add_nested(self, nested: NestedApplication, prefix: str, path: tuple[str, ...]) -> None:
        name = nested.name.replace(" ", "_")
        inner = self._others.get(name)
        if name in path or nested.name in path:
            message = f"the application `{nested.name}` contains itself"
            self._report.add(codes.NESTED_APPLICATION, nested.span, message)
        elif inner is None:
            message = f"there is no file of an application `{nested.name}`"
            self._report.add(codes.NESTED_APPLICATION, nested.span, message)
        else:
            self.add(inner, prefix + nested.prefix, (*path, name))

    def _add_program(self, module: ModuleEntry, prefix: str) -> None:
        program = module.name.split()[0].replace("\\", "/").rpartition("/")[2]
        name = self._names.claim(module.tag or re.sub(r"\.(exe|py|sh|lua)$", "", program))
        self._report_settings(module)
        by_load = bool(self._machines) and not module.node.strip("/ ")
        for machine in self._machines.values() if by_load else ():
            self._declare(machine)
        self._draft.programs.append(
            ProgramDraft(
                name,
                self._command(module),
                self._host(module),
                tuple(self._environment(module, prefix + module.prefix)),
                max(module.wait_s, START_WAIT_S),
                by_load,
            )
        )

    def _command(self, module: ModuleEntry) -> str:
        words = split_arguments(f"{module.name} {module.parameters}")
        match module.deployer.lower():
            case "" | "local" | "yarprun":
                pass
            case "yarpdev":
                words = ["yarpdev", "--device", *words]
            case _:
                words = [module.deployer, *words]
                message = (
                    f"`{module.name}` is run by `{module.deployer}`; YARP searches the script in"
                    " its contexts, `rcdeploy` in the folder of the DDSL file"
                )
                self._report.add(codes.SETTING_DROPPED, module.span, message)
        if module.dependencies:
            words = [*self._wait_words(module), *words]
        elif module.workdir:
            words = ["env", "-C", module.workdir, *words]
        return shlex.join(words)

    def _wait_words(self, module: ModuleEntry) -> list[str]:
        """The words of the program that waits for the ports of `module`, and then becomes it."""
        timeout = max(each.timeout_s for each in module.dependencies) or PORT_TIMEOUT_S
        for dependency in module.dependencies:
            if dependency.request:
                message = (
                    f"`{module.name}` starts when `{dependency.port}` exists; the reply to"
                    f" `{dependency.request:.60}` is not checked"
                )
                self._report.add(codes.SETTING_DROPPED, dependency.span, message)
        ports = [each.port for each in module.dependencies]
        folder = ["--folder", module.workdir] if module.workdir else []
        return [*_WAIT.split(), "--timeout", f"{timeout:g}", *folder, *ports, "--"]

    def _host(self, module: ModuleEntry) -> str:
        """The name of the host that runs a module; empty for this machine."""
        address = module.node.strip("/ ")
        if address.lower() in LOCAL_NODES:
            return ""
        if not _HOST.fullmatch(address):
            message = f"`{module.node:.60}` is not the name of a machine; `{module.name}` runs here"
            self._report.add(codes.SETTING_DROPPED, module.span, message)
            return ""
        machine = self._machines.get(address) or ListedMachine(address, address, module.span)
        if machine.name not in self._draft.hosts:
            message = f"`{module.name}` and others run on `{address}`"
            self._report.add(codes.REMOTE_NODE, module.span, message)
        return self._declare(machine)

    def _declare(self, machine: ListedMachine) -> str:
        """The name of the host for a machine, which is declared once."""
        known = self._draft.hosts.get(machine.name)
        if known is None:
            is_local = machine.address.lower() in LOCAL_NODES
            name = "localhost" if is_local else self._hosts.claim(machine.name)
            address = "" if is_local else machine.written_address
            known = self._draft.hosts[machine.name] = HostDraft(name, address, machine.user)
        return known.name

    def _environment(self, module: ModuleEntry, prefix: str) -> list[tuple[str, str]]:
        variables = [("YARP_PORT_PREFIX", prefix)] if prefix else []
        variables += [("DISPLAY", module.display)] if module.display else []
        for entry in filter(None, (part.strip() for part in module.environment.split(";"))):
            name, separator, value = entry.partition("=")
            if separator and _VARIABLE_NAME.fullmatch(name.strip()):
                variables.append((name.strip(), value.strip()))
            else:
                message = f"`{entry:.60}` of `{module.name}` is no `NAME=value`"
                self._report.add(codes.INCOMPLETE_ELEMENT, module.span, message)
        return list(dict(variables).items())

    def _report_settings(self, module: ModuleEntry) -> None:
        unneeded = {"stdio": module.stdio, "rank": module.rank}
        for setting, value in unneeded.items():
            if value:
                message = f"`{setting}` of `{module.name}` (`{value:.60}`)"
                self._report.add(codes.SETTING_NOT_NEEDED, module.span, message)
        if module.stop_wait_s:
            message = (
                f"`{module.name}` had {module.stop_wait_s:g} s to stop; use"
                f" `rcdeploy up --grace {module.stop_wait_s:g}`"
            )
            self._report.add(codes.SETTING_DROPPED, module.span, message)
        for old, new in module.portmaps:
            message = (
                f"`{module.name}`: the port map `{old}` to `{new}`; write the new name into the"
                " parameters of the program"
            )
            self._report.add(codes.SETTING_DROPPED, module.span, message)

    def _add_connection(self, entry: ConnectionEntry, prefix: str, external: set[str]) -> None:
        source = self._end(entry.source, prefix, entry.source_external, external, entry.span)
        target = self._end(entry.target, prefix, entry.target_external, external, entry.span)
        if not source or not target:
            return
        if entry.qos:
            message = f"the quality of service `{entry.qos:.60}` was not migrated"
            self._report.add(codes.SETTING_DROPPED, entry.span, message)
        if (source, target) in self._connected:
            message = f"`{source}` is connected to `{target}` twice"
            self._report.add(codes.SETTING_NOT_NEEDED, entry.span, message)
            return
        self._connected.add((source, target))
        carrier = entry.carrier
        if re.search(r"[\s\"/;]", carrier):
            message = f"the carrier `{carrier:.60}` is not valid; the default `tcp` is used"
            self._report.add(codes.INCOMPLETE_ELEMENT, entry.span, message)
            carrier = ""
        self._draft.connections.append(ConnectionDraft(source, target, carrier))

    def _end(
        self, port: str, prefix: str, is_external: bool, external: set[str], span: Span
    ) -> str:
        """The name of a port; empty if it is no port."""
        name = port if is_external or port in external else prefix + port
        name = name if name.startswith("/") else f"/{name}"
        if re.fullmatch(r"/[^\s\"@]+", name):
            return name
        message = f"`{port:.60}` is not the name of a port; the connection was left out"
        self._report.add(codes.INCOMPLETE_ELEMENT, span, message)
        return ""


def split_arguments(text: str) -> list[str]:
    """The words of a command line, as yarpmanager splits them: only double quotes group words."""
    return [word.replace('"', "") for word in _WORD.findall(text)]
