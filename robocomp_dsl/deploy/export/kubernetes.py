"""A deployment for Kubernetes: objects in YAML, a Kustomization, and a script for the keys. Pure.

A namespace; for each component a Deployment with one replica that is never doubled, and ConfigMaps
with its network settings and configuration; the router with a Service. Keys are in Secrets that the
script makes from the folder with the keys: they are in no file here.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from typing import Any

from robocomp_dsl.deploy.export import codes, network
from robocomp_dsl.deploy.export.cluster_pod import (
    IDENTITY_LABEL,
    NAME_LABEL,
    PART_OF_LABEL,
    node_labels,
    pod_spec,
    router_pod,
)
from robocomp_dsl.deploy.export.folder import ExportFile, tree_files
from robocomp_dsl.deploy.export.image import image_files, image_name
from robocomp_dsl.deploy.export.model import (
    ROUTER,
    ROUTER_PORT,
    ExportedDeployment,
    ExportedProcess,
)
from robocomp_dsl.deploy.export.prepare import HASH_DIGITS
from robocomp_dsl.deploy.export.readme import kubernetes_readme
from robocomp_dsl.deploy.export.yaml_text import to_yaml
from robocomp_dsl.diagnostics import Report

FOLDER = "kubernetes"
MAX_CONFIG_BYTES = 900_000
"""Kubernetes limits an object to 1 MiB; a larger file stays in the image."""


def kubernetes_files(exported: ExportedDeployment, report: Report) -> dict[str, ExportFile]:
    """All files of the folder."""
    _report_losses(exported, report)
    documents: dict[str, list[dict[str, Any]]] = {
        "namespace": [_object("v1", "Namespace", exported.name, exported, namespaced=False)],
        ROUTER: _router(exported),
        **{each.service: _component(exported, each) for each in exported.processes},
    }
    files = {
        f"{FOLDER}/{name}.yaml": ExportFile(to_yaml(*objects))
        for name, objects in documents.items()
    }
    kustomization = {
        "apiVersion": "kustomize.config.k8s.io/v1beta1",
        "kind": "Kustomization",
        "resources": [f"{name}.yaml" for name in documents],
        "images": [{"name": image_name(exported), "newName": image_name(exported)}],
    }
    return {
        **files,
        f"{FOLDER}/kustomization.yaml": ExportFile(to_yaml(kustomization)),
        "create-secrets.sh": ExportFile(_secrets_script(exported), executable=True),
        "README.md": ExportFile(kubernetes_readme(exported, _all_labels(exported))),
        **image_files(exported),
        **tree_files([each.tree for each in exported.processes], "content", HASH_DIGITS),
    }


def _object(
    version: str,
    kind: str,
    name: str,
    exported: ExportedDeployment,
    *,
    identity: str = "",
    namespaced: bool = True,
) -> dict[str, Any]:
    metadata: dict[str, Any] = {"name": name}
    if namespaced:
        metadata["namespace"] = exported.name
    metadata["labels"] = {PART_OF_LABEL: exported.name, **({NAME_LABEL: name} if identity else {})}
    if identity:
        metadata["annotations"] = {IDENTITY_LABEL: identity}
    return {"apiVersion": version, "kind": kind, "metadata": metadata}


def _deployment(
    exported: ExportedDeployment, name: str, identity: str, pod: dict[str, Any]
) -> dict[str, Any]:
    selector = {NAME_LABEL: name, PART_OF_LABEL: exported.name}
    return {
        **_object("apps/v1", "Deployment", name, exported, identity=identity),
        "spec": {
            "replicas": 1,
            # Two components of one name at a time would both answer.
            "strategy": {"type": "Recreate"},
            "selector": {"matchLabels": selector},
            "template": {"metadata": {"labels": selector}, "spec": pod},
        },
    }


def _config_map(exported: ExportedDeployment, name: str, data: dict[str, str]) -> dict[str, Any]:
    return {**_object("v1", "ConfigMap", name, exported), "data": data}


def _router(exported: ExportedDeployment) -> list[dict[str, Any]]:
    name = network.router_service(exported.name)
    host = network.cluster_host(name)
    settings = network.router_text(exported, host, listen="0.0.0.0")  # noqa: S104 - the pod's own
    service = {
        **_object("v1", "Service", name, exported),
        "spec": {
            "selector": {NAME_LABEL: name, PART_OF_LABEL: exported.name},
            "ports": [{"name": "zenoh-tls", "port": ROUTER_PORT, "targetPort": ROUTER_PORT}],
        },
    }
    return [
        _config_map(exported, f"{name}-network", {"network.json": settings}),
        _deployment(exported, name, ROUTER, router_pod(exported, name)),
        service,
    ]


def _component(exported: ExportedDeployment, each: ExportedProcess) -> list[dict[str, Any]]:
    objects = []
    address = network.router_service(exported.name)
    if not each.process.is_program:
        text = network.component_text(exported, each.process.name, address=address)
        objects.append(_config_map(exported, f"{each.service}-network", {"network.json": text}))
    config = next(iter(config_texts(each)), None)
    if config:
        objects.append(_config_map(exported, f"{each.service}-config", dict([config])))
    pod = pod_spec(exported, each, has_config=config is not None)
    objects.append(_deployment(exported, each.service, each.process.name, pod))
    return objects


def config_texts(each: ExportedProcess) -> Iterator[tuple[str, str]]:
    """The configuration of a component: name and text, unless it is too large or no text."""
    for config in each.configs:
        data = config.source.read_bytes()
        if len(data) <= MAX_CONFIG_BYTES:
            try:
                yield config.target.rpartition("/")[2], data.decode()
            except UnicodeDecodeError:
                continue


def _secrets_script(exported: ExportedDeployment) -> str:
    host = network.cluster_host(network.router_service(exported.name))
    identities = {network.router_service(exported.name): network.router_identity(host)} | {
        each.service: network.component_identity(each.process.name)
        for each in exported.processes
        if not each.process.is_program
    }
    lines = [
        "#!/bin/sh",
        "# Makes the Secrets from the folder with the keys, or replaces them.",
        "set -eu",
        ': "${ROBOCOMP_KEYS:?the folder with the keys, see README.md}"',
        "secret() {",
        f"  kubectl --namespace {exported.name} create secret generic --dry-run=client \\",
        '    --output yaml "$@" | kubectl apply --filename -',
        "}",
    ]
    for service, identity in identities.items():
        files = (
            f'--from-file={file}="$ROBOCOMP_KEYS"/{shlex.quote(source)}'
            for file, source in network.key_files(identity).items()
        )
        lines.append(" \\\n  ".join([f"secret {service}-keys", *files]))
    return "\n".join(lines) + "\n"


def _all_labels(exported: ExportedDeployment) -> list[str]:
    found = {f"{k}={v}" for each in exported.processes for k, v in node_labels(each).items()}
    return sorted(found)


def _report_losses(exported: ExportedDeployment, report: Report) -> None:
    for each in exported.processes:
        name, span = each.instance.name, each.instance.span
        restart = each.process.restart
        if restart.policy == "never":
            report.add(
                codes.INEXPRESSIBLE,
                span,
                f"`restart never` of `{name}` is not exported",
                help="Kubernetes restarts every container of a Deployment that ends",
            )
        if each.device_files:
            report.add(
                codes.DEVICE,
                span,
                f"`{name}` uses {', '.join(each.device_files)}",
                help="its container is privileged; a device plugin would need no privilege",
            )
