"""The pod of one component, or of the router, in Kubernetes. Pure."""

from __future__ import annotations

from typing import Any

from robocomp_dsl.deploy.export import network
from robocomp_dsl.deploy.export.image import image_name
from robocomp_dsl.deploy.export.model import (
    NETWORK_SOURCE,
    ROUTER_PORT,
    STATE,
    ExportedDeployment,
    ExportedProcess,
)
from robocomp_dsl.deploy.export.names import service_name
from robocomp_dsl.deploy.export.prepare import container_command
from robocomp_dsl.model.placement import LABEL

NAME_LABEL = "app.kubernetes.io/name"
PART_OF_LABEL = "app.kubernetes.io/part-of"
IDENTITY_LABEL = "robocomp.dev/component"
HOST_LABEL = "robocomp.dev/host"
USER_ID = 1000
_GRACE_S = 10


def node_labels(each: ExportedProcess) -> dict[str, str]:
    """The labels of the nodes on which a component may run."""
    instance = each.instance
    if instance.placement.kind == LABEL:
        return {f"robocomp.dev/{service_name(instance.placement.label)}": "true"}
    if instance.placement.kind or instance.host.is_local:
        return {}
    return {HOST_LABEL: service_name(instance.host.name)}


def router_pod(exported: ExportedDeployment, name: str) -> dict[str, Any]:
    """The pod of the router."""
    container = {
        **_container(exported, "router", container_command(network.ROUTER_PROCESS, network=True)),
        "ports": [{"name": "zenoh-tls", "containerPort": ROUTER_PORT}],
        **_probes(30.0),
        "securityContext": _security([]),
        "volumeMounts": _mounts(network=True),
    }
    return {
        **_pod(),
        "containers": [container],
        "volumes": _volumes(f"{name}-network", f"{name}-keys"),
    }


def pod_spec(
    exported: ExportedDeployment, each: ExportedProcess, *, has_config: bool
) -> dict[str, Any]:
    """The pod of a component or program."""
    process = each.process
    is_component = not process.is_program
    mounts = _mounts(network=is_component)
    volumes = (
        _volumes(f"{each.service}-network", f"{each.service}-keys")
        if is_component
        else _volumes("", "")
    )
    if has_config:
        target = each.configs[0].target
        mounts.append({"name": "config", "mountPath": target, "subPath": target.rpartition("/")[2]})
        volumes.append({"name": "config", "configMap": {"name": f"{each.service}-config"}})
    for number, path in enumerate(each.device_files):
        mounts.append({"name": f"device-{number}", "mountPath": path})
        volumes.append({"name": f"device-{number}", "hostPath": {"path": path}})
    capabilities = ["SYS_NICE"] if process.limits.realtime else []
    container = {
        **_container(exported, each.service, container_command(process, network=is_component)),
        "workingDir": str(process.cwd),
        "env": [
            {"name": "ROBOCOMP_HOST", "value": each.service},
            # `$(NAME)` is a reference in Kubernetes.
            *({"name": n, "value": v.replace("$(", "$$(")} for n, v in process.env),
        ],
        **_resources(each),
        **_probes(process.start_timeout_s),
        "securityContext": {"privileged": True} if each.device_files else _security(capabilities),
        "volumeMounts": mounts,
    }
    pod = {**_pod(), "containers": [container], "volumes": volumes}
    if labels := node_labels(each):
        pod["nodeSelector"] = labels
    return pod


def _pod() -> dict[str, Any]:
    return {
        "automountServiceAccountToken": False,
        "terminationGracePeriodSeconds": _GRACE_S,
        # The group reads the keys of the Secret; the first process copies them for its user.
        "securityContext": {
            "runAsUser": USER_ID,
            "runAsGroup": USER_ID,
            "fsGroup": USER_ID,
            "runAsNonRoot": True,
        },
    }


def _container(exported: ExportedDeployment, name: str, command: list[str]) -> dict[str, Any]:
    words = [word.replace("$(", "$$(") for word in command]
    return {"name": name, "image": image_name(exported), "command": words}


def _probes(start_s: float) -> dict[str, Any]:
    def probe(file: str) -> dict[str, Any]:
        return {"exec": {"command": ["test", "-e", f"{STATE}/{file}"]}, "periodSeconds": 1}

    return {
        "startupProbe": {**probe("ready"), "failureThreshold": max(1, round(start_s))},
        "readinessProbe": probe("ready"),
        "livenessProbe": {**probe("alive"), "failureThreshold": 3},
    }


def _resources(each: ExportedProcess) -> dict[str, Any]:
    limits = each.process.limits
    amounts: dict[str, str] = {}
    if limits.memory_bytes:
        amounts["memory"] = str(limits.memory_bytes)
    if limits.cpu:
        amounts["cpu"] = f"{round(limits.cpu * 1000)}m"
    return {"resources": {"limits": amounts}} if amounts else {}


def _security(capabilities: list[str]) -> dict[str, Any]:
    context: dict[str, Any] = {"capabilities": {"drop": ["ALL"]}}
    if capabilities:
        context["capabilities"]["add"] = capabilities
    else:
        context["allowPrivilegeEscalation"] = False
    return context


def _mounts(*, network: bool) -> list[dict[str, Any]]:
    mounts: list[dict[str, Any]] = [{"name": "state", "mountPath": STATE}]
    if network:
        mounts.append({"name": "network", "mountPath": NETWORK_SOURCE, "readOnly": True})
    return mounts


def _volumes(config_map: str, secret: str) -> list[dict[str, Any]]:
    volumes: list[dict[str, Any]] = [{"name": "state", "emptyDir": {"medium": "Memory"}}]
    if config_map:
        sources = [{"configMap": {"name": config_map}}, {"secret": {"name": secret}}]
        volumes.append({"name": "network", "projected": {"defaultMode": 0o440, "sources": sources}})
    return volumes
