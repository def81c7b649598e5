"""The hosts of a deployment: addresses, ports and labels.

In: the `host` statements. Out: hosts by name, and diagnostics.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from ipaddress import ip_address

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.codes import placement as placement_codes
from robocomp_dsl.check.ddsl.readiness import port_of
from robocomp_dsl.check.names.duplicates import unique_by_name
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.deployment import THIS_MACHINE, Host
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name

_HOST_NAME = re.compile(r"[A-Za-z0-9](?:[A-Za-z0-9_.-]*[A-Za-z0-9])?")
"""A host name, an alias of ssh's configuration, or an IPv4 address."""
_WITH_PORT = re.compile(r"(?:\[(?P<v6>[^\[\]]+)\]|(?P<name>[^:\[\]]+))(?::(?P<port>[0-9]{1,5}))?")
_LAST_PORT = 65535


def resolve_hosts(trees: Sequence[ast.Host], report: Report) -> dict[str, Host]:
    """The hosts by name."""
    unique = unique_by_name(trees, "host", report)
    hosts = {tree.name.text: _host(tree, report) for tree in unique}
    _report_shared_addresses(unique, hosts, report)
    return hosts


def _host(tree: ast.Host, report: Report) -> Host:
    user = tree.user.text if isinstance(tree.user, Name) else tree.user.value if tree.user else ""
    labels = tuple(dict.fromkeys(label.text for label in tree.labels))
    address, ssh_port = _address(tree, report)
    return Host(
        tree.name.text,
        address,
        user,
        labels,
        tree.name.span,
        port=port_of(tree.port, report),
        ssh_port=ssh_port,
    )


def _address(tree: ast.Host, report: Report) -> tuple[str, int]:
    """The host name or IP address of a machine, and the port of its ssh server (0: default)."""
    name = tree.name.text
    if tree.address is None:
        if name == THIS_MACHINE:
            return THIS_MACHINE, 0
        message = f"the host `{name}` has no address"
        right = f'write `host {name} {{ address "10.0.0.2"; }};` or a host name'
        report.add(codes.HOST_ADDRESS, tree.name.span, message, help=right)
        return "", 0
    written = tree.address.value.strip()
    if is_ip_address(written):
        return written, 0
    match = _WITH_PORT.fullmatch(written)
    if match:
        address, port = match["v6"] or match["name"], int(match["port"] or 0)
        valid = ":" in address if match["v6"] else bool(_HOST_NAME.fullmatch(address))
        valid = valid and (not match["v6"] or is_ip_address(address))
        if valid and (match["port"] is None or 1 <= port <= _LAST_PORT):
            return address, port
    message = f'"{written:.60}" is not a valid address'
    right = (
        "an address is a host name such as `robot.local`, an alias in ~/.ssh/config, or an IP "
        "address; with the port of ssh: `10.0.0.2:2222`, `[fe80::1]:2222`"
    )
    report.add(codes.HOST_ADDRESS, tree.address.span, message, help=right)
    return "", 0


def is_ip_address(written: str) -> bool:
    """Whether `written` is an IPv4 or IPv6 address."""
    try:
        ip_address(written)
    except ValueError:
        return False
    return True


def _report_shared_addresses(
    trees: Sequence[ast.Host], hosts: dict[str, Host], report: Report
) -> None:
    """Report two hosts that are one user on one machine."""
    first: dict[tuple[str, int, str], ast.Host] = {}
    for tree in trees:
        host = hosts[tree.name.text]
        if not host.address or host.is_local or tree.address is None:
            continue
        earlier = first.setdefault((host.address.lower(), host.ssh_port, host.user), tree)
        if earlier is not tree and earlier.address is not None:
            report.add(
                placement_codes.SHARED_ADDRESS,
                tree.address.span,
                f"the hosts `{earlier.name.text}` and `{tree.name.text}` have the same address",
                notes=[Note(earlier.address.span, "first used here")],
                help="write the address of the other machine, or use one host with the labels of "
                "both",
            )
