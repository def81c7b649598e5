"""The settings files of a deployment's network: of each router, each component, and the operator.

In: a deployment. Out: texts of JSON files, which name the files with keys beside them. Pure.
"""

from __future__ import annotations

import json
from typing import Any

from robocomp_dsl.deploy.network.access_rules import AccessRules
from robocomp_dsl.deploy.network.identities import (
    LOOPBACK,
    common_name,
    process_names,
    router_name,
    router_port,
    used_hosts,
)
from robocomp_dsl.deploy.network.key_folder import AUTHORITY, file_name
from robocomp_dsl.model.deployment import Deployment, Host, Instance

AUTHORITY_FILE = f"{AUTHORITY}.pem"


def identity_files(name: str) -> tuple[str, str]:
    """The names of the files with the certificate and the key of an identity."""
    return f"{file_name(name)}.pem", f"{file_name(name)}.key"


def router_settings(deployment: Deployment, host: Host, rules: AccessRules) -> str:
    """The content of `router.json` of a host; the files with keys are in the same folder."""
    hosts = used_hosts(deployment)
    index = [each.name for each in hosts].index(host.name)
    own = [LOOPBACK] if host.is_local else [host.address, LOOPBACK]
    data = {
        "name": router_name(host),
        "listen": [_endpoint(deployment.name, host, address) for address in dict.fromkeys(own)],
        # Of two hosts the later connects; this machine is last: nobody needs to reach it.
        "connect": [_endpoint(deployment.name, each) for each in hosts[:index]],
        **_files(router_name(host)),
        "access": rules.to_zenoh(),
    }
    return f"{json.dumps(data, indent=1)}\n"


def component_settings(deployment: Deployment, instance: Instance) -> str:
    """The content of the file for `ROBOCOMP_NETWORK` of the process of a component."""
    endpoint = _endpoint(deployment.name, instance.host, LOOPBACK)
    name = process_names(deployment)[instance.full_name]
    data = {"endpoints": [endpoint], **_files(common_name(name))}
    return f"{json.dumps(data, indent=1)}\n"


def operator_endpoints(deployment: Deployment) -> tuple[str, ...]:
    """Where rcdeploy connects: the router of this machine first, then those of other hosts."""
    hosts = sorted(used_hosts(deployment), key=lambda host: not host.is_local)
    return tuple(_endpoint(deployment.name, host) for host in hosts)


def _endpoint(deployment: str, host: Host, address: str = "") -> str:
    address = address or (LOOPBACK if host.is_local else host.address)
    place = f"[{address}]" if ":" in address else address
    return f"tls/{place}:{router_port(deployment, host)}"


def _files(name: str) -> dict[str, Any]:
    certificate, key = identity_files(name)
    return {"ca": AUTHORITY_FILE, "certificate": certificate, "key": key}
