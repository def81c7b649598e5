"""Signatures of parameters, components and deployments. In: objects of the model. Out: text."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robocomp_dsl.language_server.signatures.signatures_block import format_block
from robocomp_dsl.language_server.signatures.signatures_idsl import format_interface
from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.deployment import Connection, Deployment, External, Host, Instance
from robocomp_dsl.model.parameter import Kind, Parameter, ParameterSet
from robocomp_dsl.model.placement import LabelledHosts
from robocomp_dsl.model.types import Literal
from robocomp_dsl.syntax.ast import ddsl as ast


def format_parameter(parameter: Parameter) -> str:
    """A parameter as a PDSL statement."""
    if parameter.kind is Kind.GROUP:
        count = "" if parameter.single else f"[{_range(parameter)}]"
        members = [format_parameter(member) for member in parameter.members]
        return format_block(f"{parameter.name}{count}", members)
    choices = f"{{{', '.join(parameter.choices)}}}"
    parts = [
        f"{parameter.name}{_length(parameter)}",
        choices if parameter.kind is Kind.CHOICE else parameter.type_name,
        _default(parameter),
        f"[{parameter.unit}]" if parameter.unit else "",
        _range(parameter),
        "live" if parameter.live else "",
    ]
    return " ".join(part for part in parts if part) + ";"


def _parameter_set(parameters: ParameterSet) -> str:
    lines = [format_parameter(parameter) for parameter in parameters.parameters]
    return format_block(f"ComponentParams {parameters.name}", lines)


def _length(parameter: Parameter) -> str:
    """`[1:8]` behind the name of a list of values."""
    if not parameter.is_list:
        return ""
    low, high = parameter.shortest or 0, parameter.longest
    if low == high:
        return f"[{low}]"
    return f"[{low or ''}:{high or ''}]" if low or high else "[]"


def _default(parameter: Parameter) -> str:
    default = parameter.default
    if not isinstance(default, tuple):
        return "" if default is None else _literal(parameter, default)
    if default and len(default) == parameter.shortest and len(set(default)) == 1:
        return _literal(parameter, default[0])
    return f"{{{', '.join(_literal(parameter, each) for each in default)}}}" if default else ""


def _literal(parameter: Parameter, value: Literal) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if parameter.kind is Kind.STRING else str(value)


def _range(parameter: Parameter) -> str:
    if parameter.low is None and parameter.high is None:
        return ""
    low = "" if parameter.low is None else f"{parameter.low:g}"
    high = "" if parameter.high is None else f"{parameter.high:g}"
    return f"{low}:{high}"


def _component(component: Component) -> str:
    lines = [_port(port) for port in component.ports]
    lines += [f"period {component.period};", f"middleware {component.middleware};"]
    lines += [f"watchdog {component.watchdog_s:g} s;"] if component.watchdog_s else []
    return format_block(f"Component {component.name}", lines)


def _port(port: Port) -> str:
    name = "" if port.name == port.interface.name else f" as {port.name}"
    mark = f"({', '.join(port.middlewares)})" if port.middlewares else ""
    return f"{port.role} {port.interface.qualified}{mark}{name};"


def _port_with_interface(port: Port) -> str:
    return f"{_port(port)}\n{format_interface(port.interface)}"


def _instance(instance: Instance) -> str:
    host = f" on {instance.host.name}" if instance.host.name else ""
    placed = f"placed {instance.placement}" if instance.placement.kind else ""
    if instance.is_program:
        remark = f"{instance.executable}, {placed}" if placed else instance.executable
        return f"program {instance.name}{host}    // {remark}"
    remark = f"    // {placed}" if placed else ""
    head = f"component {instance.name} : {instance.component.name}{host}{remark}\n"
    over = f"middleware {instance.middleware};\n" if instance.middleware else ""
    return head + _prefix(instance) + over + _component(instance.component)


def _external(external: External) -> str:
    port = external.only_port
    at = f' at "{external.address}"' if external.address else ""
    return (
        f"extern {external.name} over {external.middleware}{at} "
        f"{port.role} {port.interface.qualified};"
    )


def _prefix(instance: Instance) -> str:
    if not instance.prefix:
        return ""
    return f'prefix "{instance.prefix}";    // runs as {instance.full_name}\n'


def _host(host: Host) -> str:
    address = f"[{host.address}]" if ":" in host.address and host.ssh_port else host.address
    address += f":{host.ssh_port}" if host.ssh_port else ""
    user = f" user {host.user};" if host.user else ""
    port = f" port {host.port};" if host.port else ""
    labels = f" labels {', '.join(host.labels)};" if host.labels else ""
    return f'host {host.name} {{ address "{address}";{user}{port}{labels} }};'


def _label(label: LabelledHosts) -> str:
    return f"label {label.label}    // of {', '.join(label.hosts)}"


def _group(group: ast.Group) -> str:
    """The head of a group, its components and exports."""
    kind = f" : {group.definition.text}" if group.definition else ""
    lines = [f"group {group.name.text}{kind}"]
    lines += ["    inprocess;"] if group.inprocess else []
    for instance in group.instances:
        of = f" : {instance.component.text}" if instance.component else ""
        lines.append(f"    component {instance.name.text}{of};")
    lines += [f"    group {inner.name.text};" for inner in group.groups]
    for export in group.exports:
        alias = "" if export.port is export.target.port else f" as {export.port.text}"
        target = export.target
        lines.append(f"    export {target.port.text} from {target.instance.text}{alias};")
    return "\n".join(lines)


def _deployment(deployment: Deployment) -> str:
    connections = [_connection(connection) for connection in deployment.connections]
    externals = [_external(external) for external in deployment.externals]
    instances = [
        f"program {i.name};" if i.is_program else f"component {i.name} : {i.component.name};"
        for i in deployment.instances
    ]
    return format_block(f"Deployment {deployment.name}", instances + externals + connections)


def _connection(c: Connection) -> str:
    over = f" over {c.middleware}" if c.middleware else ""
    ends = f"{c.source.name}.{c.source_port.name} -> {c.target.name}.{c.target_port.name}"
    return f"connect {ends}{over};"


SIGNATURES: dict[type, Callable[[Any], str]] = {
    Parameter: format_parameter,
    ParameterSet: _parameter_set,
    Component: _component,
    Port: _port_with_interface,
    Instance: _instance,
    External: _external,
    Host: _host,
    LabelledHosts: _label,
    Deployment: _deployment,
    ast.Group: _group,
}
