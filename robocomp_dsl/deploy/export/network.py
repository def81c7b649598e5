"""The network of containers: a router with mutual TLS, and settings without secrets.

In: an exported deployment. Out: the JSON settings of the router and of each component; which files
with keys each of them needs. Pure. Keys never are in exported files.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from robocomp_dsl.deploy.export.model import ROUTER, ROUTER_PORT, STATE, ExportedDeployment
from robocomp_dsl.deploy.export.names import service_name
from robocomp_dsl.deploy.network.access_rules import access_rules
from robocomp_dsl.deploy.network.identities import (
    LOOPBACK,
    common_name,
    process_names,
    router_name,
)
from robocomp_dsl.deploy.network.router_plan import (
    AUTHORITY_FILE,
    component_settings,
    identity_files,
    router_settings,
)
from robocomp_dsl.deploy.placement.placed_deployment import with_instances
from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.model.deployment import Deployment, Host

ROUTER_PROCESS = Process(
    ROUTER,
    ROUTER,
    (
        *("python3", "-m", "robocomp_dsl.runtime.router", f"{STATE}/network/network.json"),
        *("--log-format", "json"),
    ),
    Path("/"),
)


_FILES = {"ca": "ca.pem", "certificate": "certificate.pem", "key": "private.key"}
"""The files with keys in a container; they are beside its settings."""


def local_host() -> Host:
    """All containers share the network of the router's container."""
    return Host("localhost", LOOPBACK, port=ROUTER_PORT)


def cluster_host(service: str) -> Host:
    """The router has the address `service`."""
    return Host("cluster", service, port=ROUTER_PORT)


def container_host(target: str, name: str) -> Host:
    """The host that stands for the containers of `target`: `compose` or `kubernetes`."""
    return local_host() if target == "compose" else cluster_host(router_service(name))


def router_service(name: str) -> str:
    """The Service of the router in a cluster, which is its DNS name in the namespace, too."""
    return f"{service_name(name)}-{ROUTER}"


def moved_to(deployment: Deployment, host: Host) -> Deployment:
    """The deployment with all components at `host`."""
    changed = {i.name: i.replace(host=host) for i in deployment.instances}
    return with_instances(deployment, changed).replace(hosts=(host,))


def router_text(exported: ExportedDeployment, host: Host, *, listen: str) -> str:
    """The settings of the router, which listens at the address `listen`."""
    rules = access_rules(exported.deployment, exported.domain)
    data = json.loads(router_settings(exported.deployment, host, rules))
    return _text({**data, **_FILES, "listen": [f"tls/{listen}:{ROUTER_PORT}"], "connect": []})


def component_text(exported: ExportedDeployment, full_name: str, *, address: str) -> str:
    """The settings of a process, which finds the router at `address`."""
    names = process_names(exported.deployment)
    instance = next(i for i in exported.deployment.instances if names.get(i.full_name) == full_name)
    data = json.loads(component_settings(exported.deployment, instance))
    return _text({**data, **_FILES, "endpoints": [f"tls/{address}:{ROUTER_PORT}"]})


def key_files(identity: str) -> dict[str, str]:
    """The files with keys as a container has them, and their names in the folder with the keys."""
    certificate, key = identity_files(identity)
    return dict(zip(_FILES.values(), (AUTHORITY_FILE, certificate, key), strict=True))


def component_identity(full_name: str) -> str:
    """The common name of a component's certificate."""
    return common_name(full_name)


def router_identity(host: Host) -> str:
    """The common name of the router's certificate."""
    return router_name(host)


def _text(data: dict[str, Any]) -> str:
    return f"{json.dumps(data, indent=1)}\n"
